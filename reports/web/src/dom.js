// SPDX-License-Identifier: Apache-2.0
// Elements. Text is text: nothing of the data is ever read as markup but the picture, which the program drew.

function made(space, name, attributes, children) {
  const node = space === undefined ? document.createElement(name) : document.createElementNS(space, name);
  for (const [key, value] of Object.entries(attributes)) {
    if (value === false || value === undefined || value === null) continue;
    if (typeof value === 'function')
      node.addEventListener(key, value);
    else
      node.setAttribute(key, value === true ? '' : String(value));
  }
  node.append(...children.filter(child => child !== null && child !== undefined && child !== ''));
  return node;
}

// element('a', {href: '#1', click: handler}, 'text', child): what is false, null or undefined is left out.
export const element = (name, attributes = {}, ...children) => made(undefined, name, attributes, children);
export const svgElement = (name, attributes = {}, ...children) =>
    made('http://www.w3.org/2000/svg', name, attributes, children);
export const mathElement = (name, attributes = {}, ...children) =>
    made('http://www.w3.org/1998/Math/MathML', name, attributes, children);

// A picture on a button, of 16 by 16.
export const icon = path => svgElement(
    'svg', {class: 'icon', viewBox: '0 0 16 16', 'aria-hidden': 'true'}, svgElement('path', {d: path}));

export const byId = id => document.getElementById(id);
