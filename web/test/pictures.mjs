// SPDX-License-Identifier: MIT
// What is drawn, and functions that a page runs to see what is in a picture.

/** The picture as a reader saves it, as base64: drawn at once, and without what lies on it on the page, such as the numbers of a panel. */
export const drawn = async (page) => (await page.download(() => page.$eval("#save-picture", (button) => button.click()), "picture.png")).toString("base64");

/** How many pixels are not the ground, the highest and the lowest place of them, a few pixels towards the middle: of a block two
 * corners. The borders of the picture, where panels lie on it, and lines as thin as the grid's do not count. */
export async function extentOf(png) {
  const image = new Image();
  image.src = `data:image/png;base64,${png}`;
  await image.decode();
  const { width, height } = image;
  const canvas = new OffscreenCanvas(width, height).getContext("2d");
  canvas.drawImage(image, 0, 0);
  const { data } = canvas.getImageData(0, 0, width, height);
  const isGround = (x, y) => [0, 1, 2].every((c) => Math.abs(data[4 * (width * y + x) + c] - data[4 * (width * (height >> 1) + 20) + c]) < 60);
  const isIn = (x, y) => !isGround(x, y) && !isGround(x - 3, y) && !isGround(x + 3, y);
  const found = [];
  for (let y = 5; y < height - 5; ++y) for (let x = 290; x < width - 90; ++x) if (isIn(x, y)) found.push([x, y]);
  return { area: found.length, highest: found[0], lowest: found.at(-1) };
}
