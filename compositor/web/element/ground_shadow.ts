// Soft contact shadow on the ground below the object: a texture, computed once from the object's footprint, on a plane that
// CSS transforms into the view.

import { type Footprint, kFootprintSide } from "./core.js";
import type { ViewProjection } from "./view_projection.js";

const kTexels = 128; // side of the texture
const kReach = 1.8; // half side of the plane, object radii
const kSmallestBlur_px = 1.5; // hides the cells of the footprint
const kFade = 0.15; // height of the eye above the ground, below which the shadow fades; object radii

// Shadow of all surfaces up to a height, blurred by a standard deviation that grows with it. Object radii. A soft shadow is
// their weighted sum; a hard one is the last.
const kLayers = [
  { height: 0.08, blur: 0.045, weight: 0.4 },
  { height: 0.25, blur: 0.1, weight: 0.3 },
  { height: 0.6, blur: 0.17, weight: 0.2 },
  { height: Number.POSITIVE_INFINITY, blur: 0.28, weight: 0.1 },
];

/** Opacity of the shadow, kTexels x kTexels, in rows along +X. */
export function shadowTexture(footprint: Footprint, softness: number): Float32Array {
  const sum = new Float32Array(kTexels * kTexels);
  for (const layer of kLayers) {
    const last = layer === kLayers.at(-1) ? 1 - softness : 0;
    const weight = softness * layer.weight + last;
    if (weight === 0) continue;
    const covered = coverage(footprint, layer.height);
    blur(covered, Math.max((softness * layer.blur * kTexels) / (2 * kReach), kSmallestBlur_px));
    covered.forEach((value, i) => {
      sum[i] += weight * value;
    });
  }
  return sum;
}

// Bilinear samples of "the lowest surface is below `height`".
function coverage({ clearance }: Footprint, height: number): Float32Array {
  const steps = Math.min(height * 128, 254);
  const at = (i: number, j: number) =>
    i >= 0 && j >= 0 && i < kFootprintSide && j < kFootprintSide && clearance[j * kFootprintSide + i] <= steps ? 1 : 0;
  const sampled = new Float32Array(kTexels * kTexels);
  const cell = (texel: number) => ((((texel + 0.5) / kTexels) * 2 - 1) * kReach + 1) * (kFootprintSide / 2) - 0.5;
  for (let j = 0; j < kTexels; ++j) {
    const v = Math.floor(cell(j));
    const y = cell(j) - v;
    for (let i = 0; i < kTexels; ++i) {
      const u = Math.floor(cell(i));
      const x = cell(i) - u;
      sampled[j * kTexels + i] =
        (1 - y) * ((1 - x) * at(u, v) + x * at(u + 1, v)) + y * ((1 - x) * at(u, v + 1) + x * at(u + 1, v + 1));
    }
  }
  return sampled;
}

// Three box filters in both directions: close to a Gaussian of the given standard deviation.
function blur(image: Float32Array, sigma_px: number): void {
  const reach = Math.round((Math.sqrt(4 * sigma_px * sigma_px + 1) - 1) / 2);
  if (reach === 0) return;
  const line = new Float32Array(kTexels);
  for (let pass = 0; pass < 6; ++pass) {
    const [step, next] = pass % 2 === 0 ? [1, kTexels] : [kTexels, 1];
    for (let n = 0; n < kTexels; ++n) {
      for (let i = 0; i < kTexels; ++i) line[i] = image[n * next + i * step];
      let sum = 0;
      for (let i = -reach; i < kTexels; ++i) {
        sum += (line[i + reach] ?? 0) - (line[i - reach - 1] ?? 0);
        if (i >= 0) image[n * next + i * step] = sum / (2 * reach + 1);
      }
    }
  }
}

export class GroundShadow {
  private ground?: number;

  /** @param canvas element of the shadow tree, below the view */
  constructor(private readonly canvas: HTMLCanvasElement) {}

  paint(footprint: Footprint, softness: number): void {
    this.ground = footprint.ground;
    this.canvas.width = kTexels;
    this.canvas.height = kTexels;
    const image = new ImageData(kTexels, kTexels);
    shadowTexture(footprint, softness).forEach((opacity, i) => {
      image.data[4 * i + 3] = Math.round(255 * opacity);
    });
    this.canvas.getContext("2d")!.putImageData(image, 0, 0);
  }

  clear(): void {
    this.ground = undefined;
    this.canvas.hidden = true;
  }

  /** Moves the shadow into a view. From below the ground it is invisible. */
  place(view: ViewProjection, intensity: number): void {
    const { canvas, ground } = this;
    const above = ground === undefined ? 0 : Math.min(Math.max((view.eye[1] - ground) / kFade, 0), 1);
    canvas.hidden = intensity * above === 0;
    if (canvas.hidden || ground === undefined) return;
    const step = (2 * kReach) / kTexels;
    canvas.style.opacity = String(intensity * above);
    canvas.style.transform = view.planeTransform([-kReach, ground, -kReach], [step, 0, 0], [0, 0, step]);
  }
}
