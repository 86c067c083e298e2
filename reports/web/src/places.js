// SPDX-License-Identifier: Apache-2.0
// The places of figures in the page: what can be chosen there, and when they are drawn.
import {element} from './dom.js';

// Objects by the names of the columns.
const rowsOf = ({columns, rows}) =>
    rows.map(row => Object.fromEntries(columns.map((column, i) => [column, row[i]])));

class Place {
  constructor(node, figure, rows) {
    this.figure = figure;
    this.rows = rows;
    this.drawing = node.querySelector('.drawing');
    this.chosen = {};
    for (const [name, values] of Object.entries(figure.choices?.(rows) ?? {})) this.addChoice(name, values);
  }

  // At first the reference reading, or a loop, where there is one.
  addChoice(name, values) {
    this.chosen[name] = values.find(value => value === 'paper' || value === 'loop') ?? values[0];
    if (values.length < 2) return;
    const select = element('select', {}, ...values.map(value => element('option', {}, value)));
    select.value = this.chosen[name];
    select.addEventListener('change', () => {
      this.chosen[name] = select.value;
      this.draw();
    });
    this.drawing.before(element('label', {class: 'choice'}, `${name} `, select));
  }

  // Not while there is no room at all, as in a window that is being made smaller.
  draw() {
    this.width = this.drawing.clientWidth;
    if (this.width < 160) return;
    const parts = this.figure.draw(this.rows, this.width, this.chosen);
    const none = element('p', {class: 'note'}, 'Nothing to draw: none was seen.');
    this.drawing.replaceChildren(...parts.length > 0 ? parts : [none]);
  }
}

// `tables` and `figures` by name. Draws one after the other, so that the page can be read meanwhile, and again where the width changes.
export function drawFigures(tables, figures) {
  const places = [];
  for (const node of document.querySelectorAll('figure[data-figure]')) {
    const name = node.dataset.figure, table = tables[name.split('.')[0]];
    if (table === undefined)
      node.remove();
    else
      places.push(new Place(node, figures[name], rowsOf(table)));
  }
  const widths = new ResizeObserver(() => {
    for (const place of places) {
      if (place.width !== undefined && place.drawing.clientWidth !== place.width) place.draw();
    }
  });
  const next = i => {
    if (i === places.length) {
      document.documentElement.dataset.drawn = 'all';
      return;
    }
    places[i].draw();
    widths.observe(places[i].drawing);
    setTimeout(next, 0, i + 1);
  };
  setTimeout(next, 0, 0);
}
