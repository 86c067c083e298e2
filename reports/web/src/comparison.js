// SPDX-License-Identifier: Apache-2.0
// The page of two campaigns: draws its figures. Without it all else stands there.
import {compared} from './compared.js';
import {drawFigures} from './places.js';

drawFigures(JSON.parse(document.getElementById('data').textContent).figures, compared);
