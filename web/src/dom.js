// SPDX-License-Identifier: MIT
// Elements with text in them. Nothing in the page ever parses a text as markup.

/** An element of a class, with children: elements, or texts that stay texts. */
export function make(tag, className, ...children) {
  const element = document.createElement(tag);
  if (className) element.className = className;
  element.append(...children);
  return element;
}

/** A button that calls `act`. */
export function button(text, act, { title, className } = {}) {
  const element = make("button", className, text);
  element.type = "button";
  if (title) element.title = title;
  element.addEventListener("click", act);
  return element;
}

const tailLength = 12;
const rightToLeft = /[\u0590-\u08ff\ufb1d-\ufefc]/;

/** A name on one line: where it is too long its middle is left out, since names often differ only at their end. */
export function nameLine(name) {
  if (name.length < 2 * tailLength || rightToLeft.test(name)) return make("span", "name", name);
  const isHalf = /[\udc00-\udfff]/.test(name[name.length - tailLength]); // the second half of one character
  const cut = name.length - tailLength - (isHalf ? 1 : 0);
  return make("span", "name split", make("span", "head", name.slice(0, cut)), make("span", "tail", name.slice(cut)));
}

export const byId = (id) => document.getElementById(id);

/** Replaces what is in an element. */
export const fillWith = (element, ...children) => element.replaceChildren(...children);
