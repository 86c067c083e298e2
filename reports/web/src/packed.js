// SPDX-License-Identifier: Apache-2.0
// Bytes and text that the program has packed (../../html/packed.h).
import {strFromU8, unzlibSync} from 'fflate';

export const unpackedBytes = text => unzlibSync(Uint8Array.from(atob(text), letter => letter.charCodeAt(0)));
export const unpacked = text => strFromU8(unpackedBytes(text));
