// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0
// A sign as it is written in SignWriting, where this machine's user has drawn it with `draw_signwriting`.

import { api } from "../api.js";
import { drawing, h } from "../dom.js";
import { t } from "../i18n.js";

const SCALE = 1.6; // of what is usual in print: hands are read at arm's length from the screen
// Kinds of symbols by the first three digits of their keys, as the International SignWriting Alphabet 2010 has them.
const KINDS = [
  ["hand", 0x100, 0x204], ["contact", 0x205, 0x213], ["movement", 0x216, 0x2f4], ["dynamics", 0x2f5, 0x2fe],
  ["head", 0x2ff, 0x36a], ["body", 0x36d, 0x37d],
];

let written = null; // one download for all signs

/** What is drawn, by gloss; nothing where nobody has drawn any, or while the console does not answer. */
async function drawn() {
  written ??= api.get("/signwriting/signs.json");
  try {
    return (await written) || {};
  } catch {
    written = null; // to be asked for again
    return {};
  }
}

/**
 * Draws a sign.
 * @param {string} gloss
 * @param {string} source Of the table's entry: one that was recorded since is not the one that is written.
 * @returns {Promise<?HTMLElement>} Null where nothing is drawn.
 */
export async function signWriting(gloss, source) {
  const sign = (await drawn())[gloss];
  if (!sign || !source.includes(`"${sign.entry}"`)) return null;
  const { width, height } = size(sign.fsw);
  const label = t("signwriting.label", { name: gloss.replaceAll("_", " "), parts: parts(sign.fsw) });
  const picture = drawing(`/signwriting/drawings.svg#${encodeURIComponent(gloss)}`, {
    role: "img", "aria-label": label, width: width * SCALE, height: height * SCALE,
  });
  return h("figure", { class: "signwriting" }, picture, h("figcaption", { class: "faint" }, t("signwriting.from", { entry: sign.entry })));
}

/** What is drawn, in words: "hand ×2, movement ×1". */
function parts(fsw) {
  const bases = [...fsw.matchAll(/S([0-9a-f]{3})/g)].map(([, base]) => parseInt(base, 16));
  return KINDS.map(([kind, first, last]) => [kind, bases.filter((base) => base >= first && base <= last).length])
    .filter(([, count]) => count > 0).map(([kind, count]) => `${t(`signwriting.${kind}`)} ×${count}`).join(", ");
}

/** Its box: to the corner that FSW names first, from the least of all symbols' corners. */
function size(fsw) {
  const corners = [...fsw.matchAll(/(\d{3})x(\d{3})/g)].map(([, x, y]) => [Number(x), Number(y)]);
  const [width, height] = [0, 1].map((axis) => corners[0][axis] - Math.min(...corners.slice(1).map((corner) => corner[axis])));
  return { width, height };
}
