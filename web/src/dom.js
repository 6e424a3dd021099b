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

export const byId = (id) => document.getElementById(id);

/** Replaces what is in an element. */
export const fillWith = (element, ...children) => element.replaceChildren(...children);
