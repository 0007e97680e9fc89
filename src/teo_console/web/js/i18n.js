// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0
// The page's words in the user's language.

import { settings } from "./settings.js";

let words = {};

/**
 * Loads a language's words and writes them wherever the page has them.
 * @param {string} language
 * @param {?Object} names Of the welcome: what `{robot}`, `{signs}` and `{spoken}` stand for; without, words of no name do.
 */
export async function speak(language, names = null) {
  // Those of the frame and Watch, and those of the other tabs.
  const files = [`/i18n/${language}.json`, `/i18n/${language}.tabs.json`];
  const loaded = await Promise.all(files.map(async (file) => (await fetch(file)).json()));
  words = Object.assign({}, ...loaded);
  if (names) {
    const spoken = new Intl.DisplayNames([language], { type: "language" }).of(names.spoken);
    Object.assign(words, { "name.robot": names.robot, "name.signs": names.signs, "name.spoken": spoken });
  }
  settings.set("language", language);
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
