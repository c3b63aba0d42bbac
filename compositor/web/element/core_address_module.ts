// Address of the WebAssembly module for an ES module. Bundlers find this form, and copy the file beside their output.
export const coreAddress = new URL("./ray-space.wasm", import.meta.url).href;
