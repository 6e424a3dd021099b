// SPDX-License-Identifier: MIT
// Colours: Okabe and Ito's, which people with any colour vision tell apart, a little darker on light ground. The first
// five are the kinds of pairs.js. The picture and the legend, lists and words beside it have them from here.

export const tone = { first: 5, second: 6, overlap: 7, began: 8, ended: 9, region: 10 };

const dark = {
  background: "#14181d",
  tones: ["#8b98a5", "#e69f00", "#cc79a7", "#009e73", "#55606b", "#56b4e9", "#f0e442", "#ff5a3c", "#7dff9a", "#c08bff", "#7f8ea0"],
};
const light = {
  background: "#f4f6f8",
  tones: ["#7a8794", "#d07f00", "#b0508a", "#00805c", "#b4bec8", "#0072b2", "#a65c00", "#d5320f", "#087f30", "#7b3fd0", "#5b6b7c"],
};

const names = ["free", "pair", "self", "excluded", "out", "first", "second", "overlap", "began", "ended", "region"];

/** Makes the colours of a theme those of the style sheet: --free, --pair and so on. */
export function paint(element, theme) {
  paletteOf(theme).tones.forEach((tone, i) => element.style.setProperty(`--${names[i]}`, tone));
}

export const paletteOf = (theme) => (theme === "dark" ? dark : light);
