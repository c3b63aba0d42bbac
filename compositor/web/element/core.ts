// The WebAssembly module (compositor/web/core/web_core.cpp) with typed calls. Runs in pages, workers and node.

const kCellTextureWidth = 4096; // reconstruction_shader.hpp

interface Exports {
  memory: WebAssembly.Memory;
  web_error(): number;
  web_allocate(bytes: number): number;
  web_free(at: number): void;
  web_open(bytes: number, size: number, name: number, maxLevel: number): number;
  web_describe(): number;
  web_name(): number;
  web_render(width: number, height: number, azimuth: number, elevation: number, distance: number): number;
  web_render_registers(values: number, count: number): number;
  web_depth(): number;
  web_hash(bytes: number, size: number): number;
  web_shader_text(which: number): number;
  web_check_textures(maxSide: number, maxLayers: number): number;
  web_cell_rows(ring: number): number;
  web_cells(ring: number): number;
  web_photo(photo: number): number;
  web_photo_details(): number;
  web_prepare(width: number, height: number, azimuth: number, elevation: number, distance: number): number;
  web_prepare_second(): number;
  web_prepare_registers(values: number, count: number): number;
  web_stream_begin(name: number, size: number): void;
  web_stream_add(bytes: number, size: number, offset: number): number;
  web_stream_finish(size: number): number;
  web_stream_state(): number;
  web_stream_next(
    width: number, height: number, azimuth: number, elevation: number, distance: number, requested: number, count: number,
  ): number;
  web_lens(): number;
  web_footprint(ground: number): number;
  web_project(view: number, x: number, y: number, z: number): number;
  web_surface_point(view: number, x: number, y: number): number;
}

/** A ring of photos. Angles in radians, lengths in object radii. */
export interface CapturedRing {
  distance: number;
  targetHeight: number;
  elevation: number;
  azimuth: number;
}

export interface ObjectDescription {
  name: string;
  /** Size of the photos in pixels. */
  width: number;
  height: number;
  photos: number;
  rings: CapturedRing[];
  /** Half width and half height of the photos at depth 1. */
  lens: { tanHalfX: number; tanHalfY: number };
}

export const kFootprintSide = 64;

/** The object seen from below (compositor/web/view/footprint.hpp). */
export interface Footprint {
  /** Y of the ground in object radii. */
  ground: number;
  /** Height of the lowest surface above the ground in 1/128 object radii; 255: none. Rows along +X, X and Z in [-1, 1]. */
  clearance: Uint8Array<ArrayBuffer>;
}

/** Point of the surface, in object radii, with its normal. */
export interface SurfacePoint {
  position: [number, number, number];
  normal: [number, number, number];
}

/** Camera on an orbit about the object; azimuth from +Z towards +X. */
export interface Orbit {
  azimuth: number;
  elevation: number;
  distance: number;
}

/** Texts of the shaders, GLSL ES 3.00. */
export interface ShaderTexts {
  vertex: string;
  reconstruction: string;
  present: string;
  /** Names of the uniforms, in the order of ViewInputs.uniforms. */
  uniforms: string[];
}

/** Everything that WebGL needs of an object except its photos. */
export interface ObjectTextures {
  texts: ShaderTexts;
  width: number;
  height: number;
  photos: number;
  /** Per ring, rows of texels of four bytes. */
  cells: { rows: number; texels: Uint8Array<ArrayBuffer> }[];
}

export interface PhotoTexels {
  colours: Uint8Array<ArrayBuffer>; // RGBA
  details: Int8Array<ArrayBuffer>;
}

/** Inputs of the reconstruction shader for a view. */
export interface ViewInputs {
  /** Size of the image to render; with `rows`, the image that they sample. */
  width: number;
  height: number;
  ring: number;
  setupRows: number;
  /** Texels of four numbers; empty if there would be too many. */
  setups: Int32Array<ArrayBuffer>;
  /** Four numbers per uniform. */
  uniforms: Int32Array<ArrayBuffer>;
  /** Photos that the view needs. */
  photos: Int32Array<ArrayBuffer>;
  /** Four numbers per row of the view (row_sampling.hpp); empty if the rendered image is the view. */
  rows: Int32Array<ArrayBuffer>;
  /** Weight (1/256) of the second ring; 0: there is none. */
  weight: number;
  /** Inputs for the second ring, in views between two rings. */
  second?: ViewInputs;
}

/** Bytes [begin, end) of a file. */
export interface ByteRange {
  begin: number;
  end: number;
}

/** An object while it arrives. */
export interface StreamState {
  /** As soon as its geometry is there. */
  object?: ObjectDescription;
  complete: boolean;
  /** Views whose photos arrived since the last state. */
  photos: number[];
}

/** The next range that a view needs. */
export interface NextRange {
  /** True if the view can be rendered. */
  ready: boolean;
  /** Missing if there is nothing to request at present. */
  range?: ByteRange;
}

/** Failure that a visitor may read: one sentence. */
export class CoreError extends Error {}

/** Starts an instance of the module, which holds one object. */
export async function instantiate(module: BufferSource): Promise<WebAssembly.Exports> {
  const nothing = () => 0;
  const imports = {
    env: { emscripten_notify_memory_growth: nothing },
    wasi_snapshot_preview1: {
      proc_exit: (code: number) => {
        throw new CoreError(`the renderer has stopped (${code})`);
      },
      clock_time_get: nothing,
      environ_get: nothing,
      environ_sizes_get: nothing,
      fd_close: nothing,
      fd_pread: nothing,
      fd_seek: nothing,
      fd_write: nothing,
    },
  };
  try {
    const { instance } = await WebAssembly.instantiate(module, imports);
    (instance.exports._initialize as () => void)();
    return instance.exports;
  } catch (error) {
    throw new CoreError(`this browser cannot run WebAssembly with SIMD; update it (${error instanceof Error ? error.message : error})`);
  }
}

export class Core {
  private constructor(private readonly wasm: Exports) {}

  static async create(module: BufferSource): Promise<Core> {
    return new Core((await instantiate(module)) as unknown as Exports);
  }

  /**
   * Opens an .rso file. The core keeps one object.
   * @param name begins the messages of errors
   * @param maxLevel highest progressive level to read: 0 (a few photos) to 3 (all)
   */
  open(file: Uint8Array, name: string, maxLevel = 3): ObjectDescription {
    const text = new TextEncoder().encode(`${name}\0`);
    const bytes = this.copied(file);
    const title = this.copied(text);
    const opened = this.guarded(() => this.wasm.web_open(bytes, file.length, title, maxLevel));
    this.wasm.web_free(bytes);
    this.wasm.web_free(title);
    if (!opened) throw this.lastError();
    return this.describe();
  }

  /** Renders a view: straight RGBA. The array is valid until the next call. */
  render(width: number, height: number, view: Orbit): Uint8ClampedArray<ArrayBuffer> {
    const { azimuth, elevation, distance } = view;
    return this.pixels(this.guarded(() => this.wasm.web_render(width, height, azimuth, elevation, distance)), width * height);
  }

  /** Computes the object's footprint from its shape maps. */
  footprint(): Footprint {
    const ground = this.copied(new Uint8Array(8));
    const at = this.guarded(() => this.wasm.web_footprint(ground));
    const clearance = new Uint8Array(this.wasm.memory.buffer, at, kFootprintSide ** 2).slice();
    const [y] = this.doubles(ground, 1);
    this.wasm.web_free(ground);
    return { ground: y, clearance };
  }

  /** Surface at a pixel position of a view; undefined beside the object. */
  surfacePoint(width: number, height: number, view: Orbit, x: number, y: number): SurfacePoint | undefined {
    const at = this.withView(width, height, view, (orbit) => this.wasm.web_surface_point(orbit, x, y));
    if (!at) return undefined;
    const [px, py, pz, nx, ny, nz] = this.doubles(at, 6);
    return { position: [px, py, pz], normal: [nx, ny, nz] };
  }

  /** Pixel position and depth of a point in a view. */
  project(width: number, height: number, view: Orbit, point: [number, number, number]): { x: number; y: number; depth: number } {
    const [x, y, depth] = this.doubles(this.withView(width, height, view, (orbit) => this.wasm.web_project(orbit, ...point)), 3);
    return { x, y, depth };
  }

  private lens(): ObjectDescription["lens"] {
    const [tanHalfX, tanHalfY] = this.doubles(this.wasm.web_lens(), 2);
    return { tanHalfX, tanHalfY };
  }

  private withView(width: number, height: number, view: Orbit, call: (orbit: number) => number): number {
    const orbit = this.copied(new Uint8Array(Float64Array.of(width, height, view.azimuth, view.elevation, view.distance).buffer));
    const result = this.guarded(() => call(orbit));
    this.wasm.web_free(orbit);
    return result;
  }

  /** Renders the view of given registers (web_core.cpp lists them). Returns the hashes of its pixels and depths. */
  hashesOf(registers: number[]): { rgba: string; depth: string } {
    const values = this.copied(new Uint8Array(Float64Array.from(registers).buffer));
    const at = this.guarded(() => this.wasm.web_render_registers(values, registers.length));
    this.wasm.web_free(values);
    if (!at) throw this.lastError();
    const size = 4 * registers[0] * registers[1];
    const hash = (start: number) => this.text(this.wasm.web_hash(start, size));
    return { rgba: hash(at), depth: hash(this.wasm.web_depth()) };
  }

  /** Textures of the object, or an error if they exceed the limits of WebGL. */
  textures(maxSide: number, maxLayers: number): ObjectTextures {
    if (!this.wasm.web_check_textures(maxSide, maxLayers)) throw this.lastError();
    const text = (which: number) => this.text(this.wasm.web_shader_text(which));
    const [width, height, photos, rings] = this.doubles(this.wasm.web_describe(), 4);
    const cells = Array.from({ length: rings }, (_, ring) => {
      const at = this.guarded(() => this.wasm.web_cells(ring));
      const rows = this.wasm.web_cell_rows(ring);
      return { rows, texels: new Uint8Array(this.wasm.memory.buffer, at, 4 * kCellTextureWidth * rows).slice() };
    });
    const texts = { vertex: text(0), reconstruction: text(1), present: text(2), uniforms: text(3).split(" ") };
    return { texts, width, height, photos, cells };
  }

  /** Decodes a photo. */
  photo(photo: number): PhotoTexels {
    const [width, height] = this.doubles(this.wasm.web_describe(), 2);
    const at = this.guarded(() => this.wasm.web_photo(photo));
    const { buffer } = this.wasm.memory;
    return {
      colours: new Uint8Array(buffer, at, 4 * width * height).slice(),
      details: new Int8Array(buffer, this.wasm.web_photo_details(), width * height).slice(),
    };
  }

  /** Inputs of WebGL for a view. */
  prepare(width: number, height: number, view: Orbit): ViewInputs {
    const { azimuth, elevation, distance } = view;
    const nearest = this.inputs(this.guarded(() => this.wasm.web_prepare(width, height, azimuth, elevation, distance)));
    if (nearest.weight === 0) return nearest;
    return { ...nearest, second: this.inputs(this.guarded(() => this.wasm.web_prepare_second())) };
  }

  /** Inputs of WebGL for the view of given registers. */
  prepareRegisters(registers: number[]): ViewInputs {
    const values = this.copied(new Uint8Array(Float64Array.from(registers).buffer));
    const at = this.guarded(() => this.wasm.web_prepare_registers(values, registers.length));
    this.wasm.web_free(values);
    return this.inputs(at);
  }

  /** XXH64 as hexadecimal digits. */
  hash(bytes: Uint8Array): string {
    const at = this.copied(bytes);
    const digits = this.text(this.wasm.web_hash(at, bytes.length));
    this.wasm.web_free(at);
    return digits;
  }

  private inputs(at: number): ViewInputs {
    if (!at) throw this.lastError();
    const { buffer } = this.wasm.memory;
    const numbers = new Int32Array(buffer, at, 13);
    const [width, height, ring, setupRows, weight] = numbers;
    const copy = (n: number, each: number) => new Int32Array(buffer, numbers[n], each * numbers[n + 1]).slice();
    const [setups, uniforms, photos, rows] = [copy(5, 4), copy(7, 4), copy(9, 1), copy(11, 4)];
    return { width, height, ring, setupRows, weight, setups, uniforms, photos, rows };
  }

  private pixels(at: number, count: number): Uint8ClampedArray<ArrayBuffer> {
    if (!at) throw this.lastError();
    return new Uint8ClampedArray(this.wasm.memory.buffer, at, 4 * count);
  }

  private copied(bytes: Uint8Array): number {
    const at = this.wasm.web_allocate(Math.max(bytes.length, 1));
    if (!at) throw new CoreError("not enough memory for the object; close other pages");
    new Uint8Array(this.wasm.memory.buffer, at, bytes.length).set(bytes);
    return at;
  }

  private doubles(at: number, count: number): number[] {
    return Array.from(new Float64Array(this.wasm.memory.buffer, at, count));
  }

  private text(at: number): string {
    const bytes = new Uint8Array(this.wasm.memory.buffer, at);
    return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
  }

  private lastError(): CoreError {
    return new CoreError(this.text(this.wasm.web_error()));
  }

  // A module without exceptions traps where memory ends.
  private guarded(call: () => number): number {
    try {
      return call();
    } catch (error) {
      if (error instanceof WebAssembly.RuntimeError) {
        throw new CoreError("not enough memory for the object; close other pages, or encode it with fewer photos");
      }
      throw error;
    }
  }

  private describe(): ObjectDescription {
    const at = this.wasm.web_describe();
    const [width, height, photos, rings] = this.doubles(at, 4);
    const description: ObjectDescription = { name: this.text(this.wasm.web_name()), width, height, photos, rings: [], lens: this.lens() };
    for (let ring = 0; ring < rings; ++ring) {
      const [distance, targetHeight, elevation, azimuth] = this.doubles(at + 32 * (ring + 1), 4);
      description.rings.push({ distance, targetHeight, elevation, azimuth });
    }
    return description;
  }

  /**
   * Begins an object that arrives in parts, in place of the one opened before.
   * @param size of the file in bytes; negative if it is unknown
   */
  beginStream(name: string, size: number): void {
    const title = this.copied(new TextEncoder().encode(`${name}\0`));
    this.wasm.web_stream_begin(title, size);
    this.wasm.web_free(title);
  }

  /** Takes bytes of the file. Those of one chunk must arrive in order. */
  addBytes(offset: number, bytes: Uint8Array): StreamState {
    const at = this.copied(bytes);
    const added = this.guarded(() => this.wasm.web_stream_add(at, bytes.length, offset));
    this.wasm.web_free(at);
    if (!added) throw this.lastError();
    const state = this.wasm.web_stream_state();
    const [described, complete, photos] = this.doubles(state, 3);
    return { object: described ? this.describe() : undefined, complete: complete !== 0, photos: this.doubles(state + 24, photos) };
  }

  /** Fails if parts are missing in a file that ended after `size` bytes. */
  finishStream(size: number): void {
    if (!this.wasm.web_stream_finish(size)) throw this.lastError();
  }

  /** @param requested ranges that are being loaded */
  nextRange(width: number, height: number, view: Orbit, requested: ByteRange[]): NextRange {
    const values = this.copied(new Uint8Array(Float64Array.from(requested.flatMap(({ begin, end }) => [begin, end])).buffer));
    const { azimuth, elevation, distance } = view;
    const next = this.wasm.web_stream_next(width, height, azimuth, elevation, distance, values, requested.length);
    this.wasm.web_free(values);
    const [ready, begin, end] = this.doubles(next, 3);
    return { ready: ready !== 0, range: begin < end ? { begin, end } : undefined };
  }
}
