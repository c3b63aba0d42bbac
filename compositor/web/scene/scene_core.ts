// One object in a scene, by the WebAssembly module (compositor/web/core/web_scene.cpp). Runs in workers and pages.

import { CoreError, instantiate } from "../element/core.js";

interface SceneExports {
  memory: WebAssembly.Memory;
  web_allocate(bytes: number): number;
  web_free(at: number): void;
  web_scene_error(): number;
  web_scene_open(bytes: number, size: number, name: number): number;
  web_scene_render(values: number): number;
  web_scene_image(): number;
  web_scene_depths(): number;
}

/** In object radii: the cylinder that contains the object, its lowest and its highest point. */
export interface ObjectBounds {
  radius: number;
  bottom: number;
  top: number;
  foot: number;
  head: number;
}

/** An object in a scene, and the eye point that it is seen from. */
export interface Sight {
  /** Column-major matrix of the object's node: a similarity. */
  matrix: ArrayLike<number>;
  /** The object's foot is at the node's origin; otherwise the centre of its capture. */
  standing: boolean;
  eye: readonly [number, number, number];
  /** Focal length of the camera in pixels. */
  focal: number;
  /** Larger views are rendered at lower resolution. */
  maxPixels: number;
}

/**
 * A view of an object on a virtual screen about it, in scene coordinates: the ray through position (x, y) of the screen
 * is rays * (x, y, 1). Reciprocal axial depths of planes are linear forms of (x, y, 1)
 * (compositor/viewer/views/object_view.hpp).
 */
export interface SceneView {
  width: number;
  height: number;
  /** x, y, width and height on the screen. */
  rectangle: number[];
  samples: number;
  smooth: boolean;
  fromAbove: boolean;
  unitsPerRigUnit: number;
  distance: number;
  facing: number[];
  foot: number[];
  imageFromScreen: number[];
  eye: number[];
  rays: number[];
  /** Straight RGBA, sRGB. */
  pixels: Uint8Array<ArrayBuffer>;
  /** Axial depths of the image's camera, in rig units; 0 where transparent. */
  depths: Float32Array<ArrayBuffer>;
}

const kViewNumbers = 38;

export class SceneCore {
  private constructor(
    private readonly wasm: SceneExports,
    readonly bounds: ObjectBounds,
  ) {}

  /** Opens an .rso file. `name` begins the messages of errors. */
  static async open(module: BufferSource, file: Uint8Array, name: string): Promise<SceneCore> {
    const wasm = (await instantiate(module)) as unknown as SceneExports;
    const copied = (bytes: Uint8Array): number => {
      const at = wasm.web_allocate(bytes.length);
      if (!at) throw new CoreError(`${name}: not enough memory; close other pages`);
      new Uint8Array(wasm.memory.buffer, at, bytes.length).set(bytes);
      return at;
    };
    const bytes = copied(file);
    const title = copied(new TextEncoder().encode(`${name}\0`));
    const at = guarded(name, () => wasm.web_scene_open(bytes, file.length, title));
    wasm.web_free(bytes);
    wasm.web_free(title);
    if (!at) throw lastError(wasm);
    const [radius, bottom, top, foot, head] = new Float64Array(wasm.memory.buffer, at, 5);
    return new SceneCore(wasm, { radius, bottom, top, foot, head });
  }

  /** Renders a view; undefined if nothing is seen. */
  render(sight: Sight): SceneView | undefined {
    const values = Float64Array.of(...Array.from(sight.matrix), Number(sight.standing), ...sight.eye, sight.focal, sight.maxPixels);
    const given = this.wasm.web_allocate(values.byteLength);
    new Float64Array(this.wasm.memory.buffer, given, values.length).set(values);
    const at = guarded("view", () => this.wasm.web_scene_render(given));
    this.wasm.web_free(given);
    if (!at) throw lastError(this.wasm);
    const [seen] = new Float64Array(this.wasm.memory.buffer, at, 1);
    if (seen === 0) return undefined;
    const numbers = Array.from(new Float64Array(this.wasm.memory.buffer, at, kViewNumbers));
    const [width, height] = numbers;
    const memory = this.wasm.memory.buffer as ArrayBuffer;
    return {
      width,
      height,
      rectangle: numbers.slice(2, 6),
      samples: numbers[6],
      smooth: numbers[7] !== 0,
      fromAbove: numbers[8] !== 0,
      unitsPerRigUnit: numbers[9],
      distance: numbers[10],
      facing: numbers.slice(11, 14),
      foot: numbers.slice(14, 17),
      imageFromScreen: numbers.slice(17, 26),
      eye: numbers.slice(26, 29),
      rays: numbers.slice(29, 38),
      pixels: new Uint8Array(memory, this.wasm.web_scene_image(), 4 * width * height).slice(),
      depths: new Float32Array(memory, this.wasm.web_scene_depths(), width * height).slice(),
    };
  }
}

function lastError(wasm: SceneExports): CoreError {
  const bytes = new Uint8Array(wasm.memory.buffer, wasm.web_scene_error());
  return new CoreError(new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0))));
}

// A module without exceptions traps where memory ends.
function guarded(name: string, call: () => number): number {
  try {
    return call();
  } catch (error) {
    if (!(error instanceof WebAssembly.RuntimeError)) throw error;
    throw new CoreError(`${name}: not enough memory; close other pages, or encode it with fewer photos`);
  }
}
