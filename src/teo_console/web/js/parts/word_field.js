// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0
// A field for a word of the table, which offers those that there are.

import { field, h } from "../dom.js";

let fields = 0;

/** A word as people type it, to as the table writes it. */
export const glossOf = (word) => word.trim().toUpperCase().replaceAll(/\s+/g, "_");

/**
 * Makes the field.
 * @param {string} label
 * @param {Promise<Object[]>} signs Of the table; only words are offered, as soon as they are there.
 * @returns {{element: HTMLElement, value: function(): string}} `value` is the gloss as the table writes it.
 */
export function wordField(label, signs) {
  const id = `word-${++fields}`;
  const words = h("datalist", { id: `${id}-words` });
  signs.then((all) => words.append(...all.filter(({ kind }) => kind === "lexical").map(({ gloss }) => h("option", { value: gloss.replaceAll("_", " ") }))));
  const input = h("input", { type: "text", id, list: `${id}-words`, autocomplete: "off", maxlength: "60", spellcheck: "false" });
  const element = field(label, input);
  element.append(words);
  return { element, input, value: () => glossOf(input.value) };
}
