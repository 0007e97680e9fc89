// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0
// What a caption is marked with: how a sign that is not the word's own came about. Never by colour alone.

const MARKS = {
  lemma: "→",
  synonym: "=",
  spelled: "✎",
  number: "#",
  repaired: "↺",
  word_list: "≡",
  paraphrase: "≈",
};
// As the translator's own threshold below which it calls a sentence uncertain.
const SURE = 0.7;

/** The mark of a caption: its symbol, and the name under which i18n explains it; no name if it needs none. */
export function mark({ origin, confidence }) {
  if (origin in MARKS) return { symbol: MARKS[origin], name: origin };
  if (origin === "model" && confidence > 0 && confidence < SURE) return { symbol: "?", name: "uncertain" };
  return { symbol: "", name: "" };
}
