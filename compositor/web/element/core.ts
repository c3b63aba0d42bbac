// The WebAssembly module (compositor/web/core/web_core.cpp) with typed calls. Runs in pages, workers and node.

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
}

/** Camera on an orbit about the object; azimuth from +Z towards +X. */
export interface Orbit {
  azimuth: number;
  elevation: number;
  distance: number;
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
    const at = this.wasm.web_describe();
    const [width, height, photos, rings] = this.doubles(at, 4);
    const description: ObjectDescription = { name: this.text(this.wasm.web_name()), width, height, photos, rings: [] };
    for (let ring = 0; ring < rings; ++ring) {
      const [distance, targetHeight, elevation, azimuth] = this.doubles(at + 32 * (ring + 1), 4);
      description.rings.push({ distance, targetHeight, elevation, azimuth });
    }
    return description;
  }

  /** Renders a view: straight RGBA. The array is valid until the next call. */
  render(width: number, height: number, view: Orbit): Uint8ClampedArray<ArrayBuffer> {
    const { azimuth, elevation, distance } = view;
    return this.pixels(this.guarded(() => this.wasm.web_render(width, height, azimuth, elevation, distance)), width * height);
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

  private pixels(at: number, count: number): Uint8ClampedArray<ArrayBuffer> {
    if (!at) throw this.lastError();
    return new Uint8ClampedArray(this.wasm.memory.buffer, at, 4 * count);
  }

  private copied(bytes: Uint8Array): number {
    const at = this.wasm.web_allocate(bytes.length);
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
}
