// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0
// Elements from code. Text goes in as text: what people typed is never read as HTML.

/**
 * Makes an element.
 * @param {string} tag
 * @param {Object<string, *>} properties `class`, `dataset`, `on` (events by name), attributes and properties.
 * @param {...(Node|string|null|false)} children Strings become text; null and false are left out.
 * @returns {HTMLElement}
 */
export function h(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name === "class") element.className = value;
    else if (name === "dataset") Object.assign(element.dataset, value);
    else if (name === "on") for (const [event, handler] of Object.entries(value)) element.addEventListener(event, handler);
    else if (name in element && typeof value !== "string") element[name] = value;
    else element.setAttribute(name, value);
  }
  element.append(...children.filter((child) => child !== null && child !== false));
  return element;
}

/** An input with its label above it. */
export function field(label, input) {
  return h("div", { class: "field" }, h("label", { for: input.id }, label), input);
}

/** A film that plays over and over without sound; whoever shows no more of it revokes its address. */
export function filmOf(blob, label) {
  const src = URL.createObjectURL(blob);
  return h("video", { src, controls: true, loop: true, autoplay: true, playsInline: true, muted: true, class: "film", "aria-label": label });
}

const SVG = "http://www.w3.org/2000/svg";

/** A drawing of an SVG file, by its address and name in it. */
export function drawing(href, attributes) {
  const svg = document.createElementNS(SVG, "svg");
  for (const [name, value] of Object.entries(attributes)) svg.setAttribute(name, value);
  const use = document.createElementNS(SVG, "use");
  use.setAttribute("href", href);
  svg.append(use);
  return svg;
}
