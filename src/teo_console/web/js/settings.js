// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0
// What this browser remembers of its user's choices, and nothing else.

const KEY = "teo.settings";
const DEFAULTS = {
  language: (navigator.language || "es").startsWith("en") ? "en" : "es",
  captionSize: 100, // [%]
  camera: "front",
  mirrored: false,
  viewRate: 1, // the picture's seconds a second
  robotSpeed: 1, // of the planned speed
};

function stored() {
  try {
    return JSON.parse(localStorage.getItem(KEY) ?? "{}");
  } catch {
    return {}; // somebody else's, or forbidden: the defaults do
  }
}

const values = { ...DEFAULTS, ...stored() };

export const settings = {
  get: (name) => values[name],
  set(name, value) {
    values[name] = value;
    try {
      localStorage.setItem(KEY, JSON.stringify(values));
    } catch {
      // A private window keeps nothing: the choice holds until it is closed.
    }
  },
};
