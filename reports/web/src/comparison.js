// SPDX-License-Identifier: Apache-2.0
// The page of two campaigns, or of solvers: draws its figures. Without it all else stands there.
import {compared} from './compared.js';
import {watchTables} from './page.js';
import {drawFigures} from './places.js';

watchTables();
drawFigures(JSON.parse(document.getElementById('data').textContent).figures, compared);
