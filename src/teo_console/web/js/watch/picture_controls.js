// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0
// How the picture is seen: from where, mirrored, and how fast. None of it moves the robot.

import { h } from "../dom.js";

const CAMERAS = ["front", "hand", "signer"];
const RATES = [1, 0.5, 0.25];
const SHOWN_LAG = 0.5; // [s]
const REFRESH = 500; // [ms] of the delay that is shown

export function pictureControls({ live, settings, t }, view) {
  const buttons = CAMERAS.map((name) =>
    h("button", { type: "button", dataset: { camera: name }, on: { click: () => look(name) } }, t(`camera.${name}`)));
  const mirror = h("button", { type: "button", id: "mirror", on: { click: () => reflect(!settings.get("mirrored")) } }, t("picture.mirror"));
  const rate = h("select", { id: "rate" });
  for (const each of RATES) rate.append(h("option", { value: String(each) }, t(`rate.${each}`)));
  const behind = h("button", { type: "button", class: "quiet", hidden: true, on: { click: toLive } });

  function look(name) {
    settings.set("camera", name);
    view.camera(name);
    for (const button of buttons) button.setAttribute("aria-pressed", String(button.dataset.camera === name));
  }
  function reflect(on) {
    settings.set("mirrored", on);
    view.mirrored(on);
    mirror.setAttribute("aria-pressed", String(on));
  }
  function setRate() {
    live.clock.rate = view.rate = Number(rate.value);
    settings.set("viewRate", live.clock.rate);
  }
  function toLive() {
    live.clock.toLive();
    behind.hidden = true;
  }
  function showDelay() {
    if (!element.isConnected) return;
    const lag = live.clock.lag;
    behind.hidden = view.plays || live.clock.rate === 1 || lag < SHOWN_LAG;
    if (!behind.hidden) behind.textContent = t("picture.to_live", { lag: lag.toFixed(0) });
    setTimeout(showDelay, REFRESH);
  }

  rate.addEventListener("change", setRate);
  rate.value = String(settings.get("viewRate"));
  setRate();
  look(settings.get("camera"));
  reflect(settings.get("mirrored"));
  const element = h(
    "div", { class: "row picture-controls", role: "group", "aria-label": t("picture.label") },
    ...buttons, mirror, h("label", { class: "row small", for: "rate" }, t("picture.rate"), rate), behind,
  );
  setTimeout(showDelay, REFRESH);
  return element;
}
