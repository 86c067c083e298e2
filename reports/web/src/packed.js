// SPDX-License-Identifier: Apache-2.0
// Text that the program has packed (../../html/packed.h).
import {strFromU8, unzlibSync} from 'fflate';

export const unpacked = text => strFromU8(unzlibSync(Uint8Array.from(atob(text), letter => letter.charCodeAt(0))));
