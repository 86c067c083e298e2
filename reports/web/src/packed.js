// SPDX-License-Identifier: Apache-2.0
// Bytes and text that are packed, in base64: by the program (../../html/packed.h), and the solver as gzip.
export function unpackedBytes(text, format = 'deflate') {
  const bytes = Uint8Array.from(atob(text), letter => letter.charCodeAt(0));
  return new Response(new Response(bytes).body.pipeThrough(new DecompressionStream(format))).arrayBuffer();
}
export const unpacked = async text => new TextDecoder().decode(await unpackedBytes(text));
