// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0
// What the robot is told: pause, go on, and how fast to sign. It is one robot: every page sees the same.

import { h } from "../dom.js";

const SLOWEST = 10; // [%]
const STEP = 10;
// The node repeats the situation every second: a speed that it does not tell by then was not taken [ms].
const TAKEN = 1500;

export function robotControls({ socket, settings, attempt, notify, t }, listening) {
  const pause = h("button", { type: "button", id: "pause" });
  const speed = h("input", { type: "range", id: "speed", min: String(SLOWEST), max: "100", step: String(STEP) });
  const told = h("output", { for: "speed" });
  let paused = false;
  let dragged = false;
  let asked = { percent: null, until: 0 };

  pause.addEventListener("click", () => attempt(() => socket.ask("command", { order: paused ? "resume" : "pause" })));
  speed.addEventListener("input", () => {
    dragged = true;
    told.textContent = `${speed.value} %`;
  });
  speed.addEventListener("change", async () => {
    dragged = false;
    asked = { percent: Number(speed.value), until: performance.now() + TAKEN };
    settings.set("robotSpeed", Number(speed.value) / 100);
    await attempt(() => socket.ask("set_speed", { factor: Number(speed.value) / 100 }));
  });

  function show({ robot, pages }) {
    paused = robot.mode === "paused";
    pause.textContent = t(paused ? "robot.resume" : "robot.pause");
    pause.disabled = !["moving", "holding", "paused"].includes(robot.mode);
    const percent = Math.round(robot.speed_wanted * 100);
    // What is told before the node has taken a speed is the one before it.
    if (dragged || (percent !== asked.percent && performance.now() < asked.until)) return;
    asked.until = 0;
    speed.value = String(percent);
    told.textContent = `${speed.value} %`;
    remind(robot, pages);
  }

  // What runs has changed once the names of the next welcome tell so: then all of the page is said anew.
  const { languages = {}, language = "" } = socket.welcome.names ?? {};
  const signs = h("select", { id: "sign-language" }, ...Object.entries(languages).map(([code, name]) => h("option", { value: code }, name)));
  signs.value = language;
  signs.addEventListener("change", async () => {
    notify(t("robot.changing"));
    if (!(await attempt(() => socket.ask("set_language", { language: signs.value })))) signs.value = language;
  });

  // A console that has just started signs at full speed: whoever is alone with it has the speed chosen last time.
  let reminded = false;
  function remind({ speed_wanted, mode }, pages) {
    if (reminded || mode === "unknown") return;
    reminded = true;
    const usual = settings.get("robotSpeed");
    if (pages === 1 && speed_wanted === 1 && usual !== 1) attempt(() => socket.ask("set_speed", { factor: usual }));
  }

  listening.on(socket, "situation", show);
  const element = h(
    "section", { class: "card robot-controls", "aria-labelledby": "robot-title" },
    h("h2", { id: "robot-title" }, t("robot.title")),
    h("div", { class: "row" }, pause,
      h("label", { class: "speed", for: "speed" }, h("span", {}, t("robot.speed"), " ", told), speed)),
    signs.length > 1 && h("label", { class: "row small", for: "sign-language" }, t("robot.language"), signs),
    h("p", { class: "faint small" }, t("robot.another")),
  );
  if (socket.situation) show(socket.situation);
  return element;
}
