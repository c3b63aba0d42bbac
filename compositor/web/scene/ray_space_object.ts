// A ray-space object in a three.js scene. Its image is rendered in a worker from the eye of the scene's camera and shown
// on a quad towards this eye, with the depth of each pixel, so that it hides and is hidden by other things. It is lit as
// it was captured.

import * as three from "three";
import { cornersOf, kQuadIndices, onAxis, shadowCaster } from "./object_shadow.js";
import type { ObjectBounds, SceneView } from "./scene_core.js";
import type { OpenObject } from "./scene_workers.js";

const kRerender_px = 0.8; // parallax within the object since its image was rendered
const kRerenderZoom = 1.04;
const kMaxPixels = 1_000_000;
const kMaxPixelsInMotion = 200_000;
const kLightDistance = 30; // of lights that cast shadows, object radii
const kShadowSide_px = 256;
const kHides = 0.5; // pixels of at least this alpha write depth

const kVertex = `
in vec2 screen;
out vec2 place;
void main() {
  place = screen;
  gl_Position = projectionMatrix * viewMatrix * vec4(position, 1.0);
}`;

// As kObjectFragment of the desktop compositor (compositor/viewer/drawing/shaders.hpp), but the camera may have moved since
// the image was rendered: depths are those of points of the scene.
const kFragment = `
uniform mat4 projectionMatrix;
uniform sampler2D image;
uniform sampler2D depths;
uniform ivec2 imageSize;
uniform mat3 imageFromScreen;
uniform vec3 facing;
uniform vec3 foot;
uniform bool fromAbove;
uniform bool smoothTexels;
uniform int samples;
uniform float unitsPerRigUnit;
uniform vec3 eye;
uniform mat3 rays;
uniform vec2 alphas;
uniform vec4 fog;
in vec2 place;
out vec4 result;
vec4 sum = vec4(0.0);
float nearness = 0.0;
void add(ivec2 at, float weight, float depthOfImage) {
  ivec2 inside = clamp(at, ivec2(0), imageSize - 1);
  vec4 straight = texelFetch(image, inside, 0);
  float a = inside == at ? straight.a * weight : 0.0;
  sum += vec4(straight.rgb * a, a);
  float depth = texelFetch(depths, inside, 0).r;
  if (depth > 0.0) nearness += a * depthOfImage / depth;
}
void main() {
  for (int n = 0; n < samples * samples; ++n) {
    vec2 part = (vec2(n % samples, n / samples) + 0.5) / float(samples) - 0.5;
    vec3 p = imageFromScreen * vec3(place + part, 1.0);
    vec2 at = p.xy / p.z;
    if (smoothTexels) {
      vec2 first = floor(at - 0.5);
      vec2 f = at - 0.5 - first;
      ivec2 t = ivec2(first);
      add(t, (1.0 - f.x) * (1.0 - f.y), p.z);
      add(t + ivec2(1, 0), f.x * (1.0 - f.y), p.z);
      add(t + ivec2(0, 1), (1.0 - f.x) * f.y, p.z);
      add(t + ivec2(1, 1), f.x * f.y, p.z);
    } else {
      add(ivec2(floor(at)), 1.0, p.z);
    }
  }
  float alpha = sum.a / float(samples * samples);
  if (alpha == 0.0 || alpha < alphas.x || alpha >= alphas.y) discard;
  vec3 screen = vec3(place, 1.0);
  float inverseDepth = nearness > 0.0 ? nearness / sum.a / unitsPerRigUnit : dot(facing, screen);
  float atFoot = dot(foot, screen);
  inverseDepth = max(fromAbove ? max(inverseDepth, atFoot) : min(inverseDepth, atFoot), 1e-6);
  vec4 clip = projectionMatrix * viewMatrix * vec4(eye + rays * screen / inverseDepth, 1.0);
  gl_FragDepth = clamp(0.5 + 0.5 * clip.z / clip.w, 0.0, 1.0);
  result = vec4(mix(fog.rgb, sum.rgb / sum.a, fog.w), alpha);
  result = linearToOutputTexel(result);
}`;

/** Eye and size for which the last image was rendered. */
interface Rendered {
  eye: three.Vector3;
  focal: number;
  matrix: three.Matrix4;
  reduced: boolean;
}

export class RaySpaceObject3D extends three.Object3D {
  readonly isRaySpaceObject = true;
  /** Called when a new image is there. */
  onchange: () => void = () => {};
  /** Called when a view cannot be rendered; the object keeps its last image. */
  onfailure: (error: unknown) => void = () => {};

  private readonly uniforms = {
    image: { value: null as three.Texture | null },
    depths: { value: null as three.Texture | null },
    imageSize: { value: new three.Vector2() },
    imageFromScreen: { value: new three.Matrix3() },
    facing: { value: new three.Vector3() },
    foot: { value: new three.Vector3() },
    fromAbove: { value: true },
    smoothTexels: { value: false },
    samples: { value: 1 },
    unitsPerRigUnit: { value: 1 },
    eye: { value: new three.Vector3() },
    rays: { value: new three.Matrix3() },
    fog: { value: new three.Vector4(0, 0, 0, 1) },
  };
  private readonly quads: three.Mesh[];
  private readonly geometry = new three.BufferGeometry();
  private readonly corners = new three.BufferAttribute(new Float32Array(12), 3);
  private readonly places = new three.BufferAttribute(new Float32Array(8), 2);
  private rendered?: Rendered;
  private rendering = false;
  private readonly eye = new three.Vector3();

  /**
   * @param opened the object's file
   * @param standing the object's foot is at the origin; otherwise the centre of its capture
   */
  constructor(
    private readonly opened: OpenObject,
    private readonly standing = true,
  ) {
    super();
    this.geometry.setIndex(kQuadIndices);
    this.geometry.setAttribute("position", this.corners);
    this.geometry.setAttribute("screen", this.places);
    // Pixels at edges do not hide what is behind them.
    this.quads = [this.quad(kHides, 2, true), this.quad(0, kHides, false)];
    this.add(...this.quads);
  }

  private get bounds(): ObjectBounds {
    return this.opened.bounds;
  }

  /** The cylinder's middle, in local coordinates. */
  get middle(): three.Vector3 {
    const { top, bottom, foot } = this.bounds;
    return new three.Vector3(0, (top + bottom) / 2 - (this.standing ? foot : 0), 0);
  }

  /** Half of the object's height. */
  get halfHeight(): number {
    return (this.bounds.top - this.bounds.bottom) / 2;
  }

  /** Bounding sphere in world coordinates. */
  sphere(): three.Sphere {
    const radius = Math.hypot(this.bounds.radius, this.halfHeight) * this.matrixWorld.getMaxScaleOnAxis();
    return new three.Sphere(this.middle.applyMatrix4(this.matrixWorld), radius);
  }

  /** Farther objects are drawn first. */
  set order(order: number) {
    for (const [n, quad] of this.quads.entries()) quad.renderOrder = order + n / 2;
  }

  /** Sets the fog colour and the share of the object's light that passes it. */
  setFog(colour: three.Color, transmittance: number): void {
    this.uniforms.fog.value.set(colour.r, colour.g, colour.b, transmittance);
  }

  /**
   * Requests a new image if the camera has moved. Call it before each frame, with world matrices up to date.
   * @param height of the canvas in pixels
   * @param moving the camera moves: large images are rendered at lower resolution
   * @returns true if an image is missing or outdated
   */
  update(camera: three.PerspectiveCamera, height: number, moving: boolean): boolean {
    const focal = height / 2 / Math.tan(three.MathUtils.degToRad(camera.fov) / 2);
    camera.getWorldPosition(this.eye);
    if (!this.isOutdated(focal, moving) || !this.isInView(camera)) return this.rendering;
    if (!this.rendering) void this.render(focal, moving ? kMaxPixelsInMotion : kMaxPixels);
    return true;
  }

  /**
   * The object's shadow in the light of a direction, as a mesh in world coordinates that casts it.
   * @param towards direction of travel of the light, unit length
   */
  async shadowFrom(towards: three.Vector3): Promise<three.Mesh | undefined> {
    const { center, radius } = this.sphere();
    const distance = kLightDistance * radius;
    const { x, y, z } = center.clone().addScaledVector(towards, -distance);
    const focal = (kShadowSide_px / 2) * kLightDistance;
    const { elements: matrix } = this.matrixWorld.clone();
    const view = await this.opened.render({ matrix, standing: this.standing, eye: [x, y, z], focal, maxPixels: kMaxPixels });
    return view && shadowCaster(view, towards.clone().multiplyScalar(-radius));
  }

  override raycast(raycaster: three.Raycaster, hits: three.Intersection[]): void {
    const { radius } = this.bounds;
    const half = new three.Vector3(0.7 * radius, this.halfHeight, 0.7 * radius);
    const box = new three.Box3(this.middle.sub(half), this.middle.add(half));
    const ray = raycaster.ray.clone().applyMatrix4(this.matrixWorld.clone().invert());
    const point = ray.intersectBox(box, new three.Vector3())?.applyMatrix4(this.matrixWorld);
    if (point) hits.push({ distance: raycaster.ray.origin.distanceTo(point), point, object: this });
  }

  dispose(): void {
    this.geometry.dispose();
    this.uniforms.image.value?.dispose();
    this.uniforms.depths.value?.dispose();
    for (const quad of this.quads) (quad.material as three.Material).dispose();
  }

  private quad(least: number, end: number, depthWrite: boolean): three.Mesh {
    const shader = new three.ShaderMaterial({
      glslVersion: three.GLSL3,
      vertexShader: kVertex,
      fragmentShader: kFragment,
      uniforms: { ...this.uniforms, alphas: { value: new three.Vector2(least, end) } },
      transparent: true,
      depthWrite,
      side: three.DoubleSide,
    });
    const quad = new three.Mesh(this.geometry, shader);
    quad.frustumCulled = false; // in world coordinates
    quad.visible = false;
    quad.raycast = () => {};
    return quad;
  }

  private isInView(camera: three.Camera): boolean {
    const clip = new three.Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
    return new three.Frustum().setFromProjectionMatrix(clip).intersectsSphere(this.sphere());
  }

  private isOutdated(focal: number, moving: boolean): boolean {
    const last = this.rendered;
    if (!last || !last.matrix.equals(this.matrixWorld)) return true;
    if (last.reduced && !moving) return true;
    const { center, radius } = this.sphere();
    const before = last.eye.clone().sub(center);
    const now = this.eye.clone().sub(center);
    const turned = before.angleTo(now);
    const zoom = ((focal / last.focal) * before.length()) / now.length();
    const parallax_px = (turned * radius * focal) / Math.max(now.length(), 1e-6);
    return parallax_px > kRerender_px || zoom > kRerenderZoom || zoom < 1 / kRerenderZoom;
  }

  private async render(focal: number, maxPixels: number): Promise<void> {
    const matrix = this.matrixWorld.clone();
    const eye = this.eye.clone();
    this.rendering = true;
    try {
      const { x, y, z } = eye;
      const view = await this.opened.render({ matrix: matrix.elements, standing: this.standing, eye: [x, y, z], focal, maxPixels });
      const { radius } = this.sphere();
      const side = (2 * radius * focal) / Math.max(eye.distanceTo(this.sphere().center), 1e-6);
      this.rendered = { eye, focal, matrix, reduced: maxPixels < kMaxPixels && side * side > maxPixels };
      if (view) this.show(view);
      for (const quad of this.quads) quad.visible = view !== undefined;
    } catch (error) {
      this.rendered = { eye, focal, matrix, reduced: false };
      this.onfailure(error);
    } finally {
      this.rendering = false;
      this.onchange();
    }
  }

  private show(view: SceneView): void {
    const { uniforms } = this;
    const { width, height } = view;
    uniforms.image.value = filled(uniforms.image.value, view.pixels, width, height, three.RGBAFormat, three.UnsignedByteType);
    uniforms.depths.value = filled(uniforms.depths.value, view.depths, width, height, three.RedFormat, three.FloatType);
    uniforms.imageSize.value.set(width, height);
    uniforms.imageFromScreen.value.fromArray(view.imageFromScreen);
    uniforms.facing.value.fromArray(view.facing);
    uniforms.foot.value.fromArray(view.foot);
    uniforms.fromAbove.value = view.fromAbove;
    uniforms.smoothTexels.value = view.smooth;
    uniforms.samples.value = view.samples;
    uniforms.unitsPerRigUnit.value = view.unitsPerRigUnit;
    uniforms.eye.value.fromArray(view.eye);
    uniforms.rays.value.fromArray(view.rays);
    this.placeQuad(view);
  }

  // The quad is the screen rectangle at the depth of the object's axis.
  private placeQuad(view: SceneView): void {
    for (const [n, [x, y]] of cornersOf(view).entries()) {
      const corner = onAxis(view, x, y);
      this.corners.setXYZ(n, corner.x, corner.y, corner.z);
      this.places.setXY(n, x, y);
    }
    this.corners.needsUpdate = true;
    this.places.needsUpdate = true;
  }
}

// The texture with new contents, or a new one of another size.
function filled(
  last: three.Texture | null,
  data: Uint8Array<ArrayBuffer> | Float32Array<ArrayBuffer>,
  width: number,
  height: number,
  format: three.PixelFormat,
  type: three.TextureDataType,
): three.Texture {
  const image = last?.image as { width: number; height: number; data: typeof data } | undefined;
  if (last && image?.width === width && image.height === height) {
    image.data = data;
    last.needsUpdate = true;
    return last;
  }
  last?.dispose();
  const texture = new three.DataTexture(data, width, height, format, type);
  texture.colorSpace = format === three.RGBAFormat ? three.SRGBColorSpace : three.NoColorSpace;
  texture.needsUpdate = true;
  return texture;
}
