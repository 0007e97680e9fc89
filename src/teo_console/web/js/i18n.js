// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0
// The page's words in the user's language.

import { api } from "./api.js";

let words = {};

/** A language's words: those of the frame and Watch, and those of the other tabs. */
export async function wordsOf(language) {
  const files = [`/i18n/${language}.json`, `/i18n/${language}.tabs.json`];
  return Object.assign({}, ...(await Promise.all(files.map(api.get))));
}

/**
 * Writes a language's words wherever the page has them.
 * @param {string} language
 * @param {Object<string, string>} spoken Its words.
 * @param {?Object} names Of the welcome: what `{robot}`, `{signs}` and `{spoken}` stand for; without, words of no name do.
 */
export function speak(language, spoken, names) {
  words = spoken;
  if (names) {
    const named = new Intl.DisplayNames([language], { type: "language" }).of(names.spoken);
    Object.assign(words, { "name.robot": names.robot, "name.signs": names.signs, "name.spoken": named });
  }
  document.documentElement.lang = language;
  document.title = t("title");
  for (const element of document.querySelectorAll("[data-t]")) element.textContent = t(element.dataset.t);
  for (const element of document.querySelectorAll("[data-t-label]")) {
    element.setAttribute("aria-label", t(element.dataset.tLabel));
  }
}

/**
 * Gives the words of a key. A missing key is shown as it is: it is to be seen.
 * @param {string} key
 * @param {Object<string, string|number>} values For `{name}` in the words.
 */
export function t(key, values = {}) {
  return (words[key] ?? key).replace(/\{(\w+)\}/g, (whole, name) => values[name] ?? words[`name.${name}`] ?? whole);
}

/** A figure as the language writes it, with so many decimals at most. */
export const figure = (value, decimals = 1) => value.toLocaleString(document.documentElement.lang, { maximumFractionDigits: decimals });

/** Whether there are words of that key. */
export const has = (key) => key in words;
