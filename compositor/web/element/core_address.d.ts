// core_address_script.ts or core_address_module.ts (esbuild's --alias).
declare module "core-address" {
  /** Address of the WebAssembly module beside the script. */
  export const coreAddress: string;
}
