// The WebGL 2 context that all elements of a page share: browsers allow some 16 contexts. Views are drawn onto its hidden
// canvas, from which each element copies them. The shaders are those of the desktop (compositor/gpu/shader).

import type { ObjectTextures, PhotoTexels, ShaderTexts, ViewInputs } from "./core.js";

const kIdle_ms = 2000; // objects that were not drawn for so long may lose their textures
const kSetupTexels = 7; // reconstruction_shader.hpp
const kCellTextureWidth = 4096;
const kPhotoTexel_bytes = 5; // RGBA and detail

/** Failure of WebGL; the core renders instead. */
export class GlError extends Error {}

interface Program {
  program: WebGLProgram;
  uniforms: Map<string, { at: WebGLUniformLocation; type: GLenum }>;
}

interface Programs {
  texts: ShaderTexts;
  reconstruction: Program;
  present: Program;
}

// Texture that grows with what is stored in it.
interface GrowingTexture {
  texture: WebGLTexture;
  width: number;
  height: number;
}

interface Target extends GrowingTexture {
  depths: WebGLTexture;
  framebuffer: WebGLFramebuffer;
}

export class GlDevice {
  private static shared?: GlDevice;
  private static software?: boolean;

  /** Limit for the textures of all objects of a page. */
  static budget_bytes = 512 * 2 ** 20;

  /** Hidden canvas: present() draws into its lower left corner. */
  readonly canvas: HTMLCanvasElement;
  readonly maxSide: number;
  readonly maxLayers: number;
  /** Incremented when the context is lost: objects of older generations have no textures. */
  generation = 0;
  private users = 0;
  private programs?: Programs;
  private targets: Target[] = []; // of the nearest ring, and of the second one
  private setups?: GrowingTexture;
  private rows?: GrowingTexture;
  private readonly objects = new Map<GlObject, { bytes: number; drawn_ms: number }>(); // least recently drawn first

  private constructor(readonly gl: WebGL2RenderingContext) {
    this.canvas = gl.canvas as HTMLCanvasElement;
    this.maxSide = gl.getParameter(gl.MAX_TEXTURE_SIZE);
    this.maxLayers = gl.getParameter(gl.MAX_ARRAY_TEXTURE_LAYERS);
    this.canvas.addEventListener("webglcontextlost", (event) => {
      event.preventDefault(); // allows the browser to restore it
      this.forget();
    });
    this.setUp();
    this.canvas.addEventListener("webglcontextrestored", () => this.setUp());
  }

  /**
   * The page's device; each call needs a release().
   * @param allowSoftware also where WebGL runs on the CPU, where the core is faster
   * @returns undefined without WebGL 2
   */
  static acquire(allowSoftware: boolean): GlDevice | undefined {
    if (GlDevice.software && !allowSoftware) return undefined;
    if (!GlDevice.shared) {
      const options: WebGLContextAttributes = { antialias: false, depth: false };
      const gl = document.createElement("canvas").getContext("webgl2", options) as WebGL2RenderingContext | null;
      if (!gl) return undefined;
      GlDevice.software ??= isSoftware(gl);
      if (GlDevice.software && !allowSoftware) {
        lose(gl);
        return undefined;
      }
      GlDevice.shared = new GlDevice(gl);
    }
    ++GlDevice.shared.users;
    return GlDevice.shared;
  }

  /** The last user's call frees the context. */
  release(): void {
    if (--this.users > 0) return;
    if (GlDevice.shared === this) GlDevice.shared = undefined;
    lose(this.gl);
    this.canvas.width = this.canvas.height = 1;
  }

  get isLost(): boolean {
    return this.gl.isContextLost();
  }

  /** Makes room for the textures of an object. Returns false if there is none now; throws if there never will be. */
  admit(object: GlObject, bytes: number): boolean {
    const budget = GlDevice.budget_bytes;
    if (bytes > budget) throw new GlError(`the object needs ${bytes >> 20} MiB of textures, and a page has ${budget >> 20}`);
    const now = performance.now();
    let used = bytes;
    for (const each of this.objects.values()) used += each.bytes;
    for (const [each, { bytes: freed, drawn_ms }] of this.objects) {
      if (used <= budget || now - drawn_ms < kIdle_ms) break;
      each.delete();
      used -= freed;
    }
    if (used > budget) return false;
    this.objects.set(object, { bytes, drawn_ms: now });
    return true;
  }

  dismiss(object: GlObject): void {
    this.objects.delete(object);
  }

  /** Compiles the shaders, unless they are. */
  compile(texts: ShaderTexts): void {
    if (this.programs?.texts.reconstruction === texts.reconstruction) return;
    const { gl } = this;
    const reconstruction = this.link(texts.vertex, texts.reconstruction);
    const present = this.link(texts.vertex, texts.present);
    this.programs = { texts, reconstruction, present };
    const units = { setups: 0, cells: 1, photos: 2, details: 3 };
    gl.useProgram(reconstruction.program);
    for (const [name, unit] of Object.entries(units)) this.setUniform(reconstruction, name, [unit]);
    gl.useProgram(present.program);
    this.setUniform(present, "image", [0]);
    this.setUniform(present, "rows", [1]);
    this.setUniform(present, "second", [2]);
  }

  /**
   * Renders the image of a ring into a target, where it is read by present() and read(). All photos that it needs are
   * uploaded.
   * @param target 0: nearest ring, 1: second ring
   * @param withDepth also renders the axial depths
   */
  draw(object: GlObject, inputs: ViewInputs, { target = 0, withDepth = false } = {}): void {
    const { gl } = this;
    const { width, height, setupRows } = inputs;
    this.reserveTarget(target, width, height);
    const { texts, reconstruction } = this.programs!;
    gl.useProgram(reconstruction.program);
    for (const [n, name] of texts.uniforms.entries()) {
      this.setUniform(reconstruction, name, inputs.uniforms.subarray(4 * n, 4 * n + 4));
    }
    object.bind(inputs.ring);
    const used = this.objects.get(object)!;
    this.objects.delete(object);
    this.objects.set(object, { ...used, drawn_ms: performance.now() });
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.targets[target].framebuffer);
    gl.drawBuffers([gl.COLOR_ATTACHMENT0, withDepth ? gl.COLOR_ATTACHMENT1 : gl.NONE]);
    gl.enable(gl.SCISSOR_TEST);
    gl.viewport(0, 0, width, height);
    const upright = setupRows === 1;
    const rowsAtOnce = upright ? 1 : Math.min(setupRows, Math.floor(this.maxSide / kSetupTexels));
    const perRow = 4 * kSetupTexels * width;
    for (let first = 0; first < setupRows; first += rowsAtOnce) {
      const rows = Math.min(rowsAtOnce, setupRows - first);
      const part = inputs.setups.subarray(first * perRow, (first + rows) * perRow);
      this.setups = this.store(this.setups, 0, width, rows * kSetupTexels, part);
      this.setUniform(reconstruction, "setup_rows", [first, upright ? 0 : kSetupTexels]);
      gl.scissor(0, first, width, upright ? height : rows);
      gl.drawArrays(gl.TRIANGLES, 0, 3);
    }
    gl.disable(gl.SCISSOR_TEST);
  }

  /** Mixes the last images of draw() and draws them onto the canvas, whose lower left corner gets width x height pixels. */
  present(width: number, height: number, inputs: ViewInputs): void {
    const { gl, canvas } = this;
    if (canvas.width < width) canvas.width = width;
    if (canvas.height < height) canvas.height = height;
    const { present: program } = this.programs!;
    gl.useProgram(program.program);
    const isSampled = inputs.rows.length > 0;
    this.rows = this.store(this.rows, 1, 1, isSampled ? height : 1, isSampled ? inputs.rows : new Int32Array(4));
    const images = [this.targets[0].texture, this.targets[inputs.second ? 1 : 0].texture];
    for (const [n, unit] of [gl.TEXTURE0, gl.TEXTURE2].entries()) {
      gl.activeTexture(unit);
      gl.bindTexture(gl.TEXTURE_2D, images[n]);
    }
    this.setUniform(program, "weight", [inputs.second ? inputs.weight : 0]);
    this.setUniform(program, "image_size", [inputs.width, inputs.height]);
    this.setUniform(program, "height", [height]);
    this.setUniform(program, "is_sampled", [isSampled ? 1 : 0]);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, width, height);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  /** Reads the last image of the nearest ring: straight RGBA, and axial depths (q20) if they were drawn. For tests. */
  read(width: number, height: number): { rgba: Uint8Array; depth: Int32Array } {
    const { gl } = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.targets[0].framebuffer);
    const rgba = new Uint8Array(4 * width * height);
    gl.readBuffer(gl.COLOR_ATTACHMENT0);
    gl.readPixels(0, 0, width, height, gl.RGBA_INTEGER, gl.UNSIGNED_BYTE, rgba);
    // Only the format RGBA_INTEGER with INT is readable everywhere.
    const numbers = new Int32Array(4 * width * height);
    gl.readBuffer(gl.COLOR_ATTACHMENT1);
    gl.readPixels(0, 0, width, height, gl.RGBA_INTEGER, gl.INT, numbers);
    return { rgba, depth: numbers.filter((_, i) => i % 4 === 0) };
  }

  // State that draw() and present() rely on.
  private setUp(): void {
    const { gl } = this;
    gl.disable(gl.BLEND);
    gl.disable(gl.DITHER);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
  }

  private forget(): void {
    ++this.generation;
    this.programs = this.setups = this.rows = undefined;
    this.targets = [];
    this.objects.clear();
  }

  private link(vertex: string, fragment: string): Program {
    const { gl } = this;
    const program = gl.createProgram();
    for (const [type, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]] as const) {
      const shader = gl.createShader(type)!;
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
      gl.deleteShader(shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
      throw new GlError(`the browser does not compile the shaders: ${gl.getProgramInfoLog(program)}`);
    }
    const uniforms: Program["uniforms"] = new Map();
    for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); ++i) {
      const { name, type } = gl.getActiveUniform(program, i)!;
      uniforms.set(name, { at: gl.getUniformLocation(program, name)!, type });
    }
    return { program, uniforms };
  }

  // Sets an integer uniform of the current program. There may be more values than its type has.
  private setUniform({ uniforms }: Program, name: string, [x, y, z, w]: Iterable<number>): void {
    const { gl } = this;
    const { at, type } = uniforms.get(name)!;
    if (type === gl.INT_VEC4) gl.uniform4i(at, x, y, z, w);
    else if (type === gl.INT_VEC2) gl.uniform2i(at, x, y);
    else gl.uniform1i(at, x);
  }

  private reserveTarget(n: number, width: number, height: number): void {
    const { gl } = this;
    const before: Target | undefined = this.targets[n];
    if (before && before.width >= width && before.height >= height) return;
    const side = { width: Math.max(width, before?.width ?? 1), height: Math.max(height, before?.height ?? 1) };
    if (before) {
      gl.deleteTexture(before.texture);
      gl.deleteTexture(before.depths);
      gl.deleteFramebuffer(before.framebuffer);
      delete this.targets[n];
    }
    const framebuffer = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
    const attached = (format: number, attachment: number) => {
      const texture = this.texture(gl.TEXTURE_2D, 0);
      gl.texStorage2D(gl.TEXTURE_2D, 1, format, side.width, side.height);
      gl.framebufferTexture2D(gl.FRAMEBUFFER, attachment, gl.TEXTURE_2D, texture, 0);
      return texture;
    };
    const texture = attached(gl.RGBA8UI, gl.COLOR_ATTACHMENT0);
    const depths = attached(gl.R32I, gl.COLOR_ATTACHMENT1);
    if (!this.isLost && gl.checkFramebufferStatus(gl.FRAMEBUFFER) !== gl.FRAMEBUFFER_COMPLETE) {
      throw new GlError("WebGL does not render integers");
    }
    this.targets[n] = { ...side, texture, depths, framebuffer };
  }

  /** A new texture without filtering, bound to a unit. */
  texture(kind: number, unit: number): WebGLTexture {
    const { gl } = this;
    const texture = gl.createTexture();
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(kind, texture);
    gl.texParameteri(kind, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(kind, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    return texture;
  }

  // Stores texels of four numbers, and leaves the texture bound to the unit.
  private store(at: GrowingTexture | undefined, unit: number, width: number, height: number, texels: Int32Array): GrowingTexture {
    const { gl } = this;
    let stored = at;
    if (!stored || stored.width < width || stored.height < height) {
      if (stored) gl.deleteTexture(stored.texture);
      const side = { width: Math.max(width, stored?.width ?? 1), height: Math.max(height, stored?.height ?? 1) };
      stored = { ...side, texture: this.texture(gl.TEXTURE_2D, unit) };
      gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA32I, side.width, side.height);
    }
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, stored.texture);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, width, height, gl.RGBA_INTEGER, gl.INT, texels);
    return stored;
  }
}

/** Textures of an object: its cells, and a layer per photo. */
export class GlObject {
  readonly generation: number;
  private readonly uploaded = new Set<number>();
  private photos?: WebGLTexture;
  private details?: WebGLTexture;
  private cells: WebGLTexture[] = [];

  private constructor(
    private readonly device: GlDevice,
    private readonly size: { width: number; height: number },
  ) {
    this.generation = device.generation;
  }

  /** Returns undefined if there is no memory now; throws GlError if the object cannot be drawn. */
  static create(device: GlDevice, textures: ObjectTextures): GlObject | undefined {
    device.compile(textures.texts);
    const { width, height, photos, cells } = textures;
    const object = new GlObject(device, { width, height });
    let bytes = kPhotoTexel_bytes * width * height * photos;
    for (const { texels } of cells) bytes += texels.length;
    if (!device.admit(object, bytes)) return undefined;
    const { gl } = device;
    while (gl.getError() !== gl.NO_ERROR && !device.isLost);
    object.photos = device.texture(gl.TEXTURE_2D_ARRAY, 2);
    gl.texStorage3D(gl.TEXTURE_2D_ARRAY, 1, gl.RGBA8UI, width, height, photos);
    object.details = device.texture(gl.TEXTURE_2D_ARRAY, 3);
    gl.texStorage3D(gl.TEXTURE_2D_ARRAY, 1, gl.R8I, width, height, photos);
    object.cells = cells.map(({ rows, texels }) => {
      const texture = device.texture(gl.TEXTURE_2D, 1);
      gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA8UI, kCellTextureWidth, rows);
      gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, kCellTextureWidth, rows, gl.RGBA_INTEGER, gl.UNSIGNED_BYTE, texels);
      return texture;
    });
    if (!device.isLost && gl.getError() !== gl.NO_ERROR) {
      object.delete();
      throw new GlError("the graphics processor has no memory for the object");
    }
    return object;
  }

  /** False after delete(), or after the context was lost. */
  get isValid(): boolean {
    return this.photos !== undefined && this.generation === this.device.generation && !this.device.isLost;
  }

  /** Photos of a list that are not uploaded. */
  missing(photos: Iterable<number>): number[] {
    return [...photos].filter((photo) => !this.uploaded.has(photo));
  }

  upload(photo: number, { colours, details }: PhotoTexels): void {
    const { gl } = this.device;
    const { width, height } = this.size;
    const layer = (unit: number, texture: WebGLTexture, format: number, type: number, texels: ArrayBufferView) => {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(gl.TEXTURE_2D_ARRAY, texture);
      gl.texSubImage3D(gl.TEXTURE_2D_ARRAY, 0, 0, 0, photo, width, height, 1, format, type, texels);
    };
    layer(2, this.photos!, gl.RGBA_INTEGER, gl.UNSIGNED_BYTE, colours);
    layer(3, this.details!, gl.RED_INTEGER, gl.BYTE, details);
    this.uploaded.add(photo);
  }

  /** Binds the textures of a ring to the units of the reconstruction shader. */
  bind(ring: number): void {
    const { gl } = this.device;
    const bound = [[gl.TEXTURE_2D, this.cells[ring]], [gl.TEXTURE_2D_ARRAY, this.photos!], [gl.TEXTURE_2D_ARRAY, this.details!]] as const;
    for (const [n, [kind, texture]] of bound.entries()) {
      gl.activeTexture(gl.TEXTURE1 + n);
      gl.bindTexture(kind, texture);
    }
  }

  /** Frees the textures. */
  delete(): void {
    this.device.dismiss(this);
    if (this.generation === this.device.generation) {
      const { gl } = this.device;
      for (const texture of [this.photos, this.details, ...this.cells]) gl.deleteTexture(texture ?? null);
    }
    this.photos = this.details = undefined;
    this.cells = [];
    this.uploaded.clear();
  }
}

function isSoftware(gl: WebGL2RenderingContext): boolean {
  const names = gl.getExtension("WEBGL_debug_renderer_info");
  const name = String(gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER));
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}

function lose(gl: WebGL2RenderingContext): void {
  gl.getExtension("WEBGL_lose_context")?.loseContext();
}
