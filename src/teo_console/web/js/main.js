// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0
// The page: header, tabs by the address's hash, and what every tab is given.

import { api } from "./api.js";
import { h } from "./dom.js";
import { speak, t, wordsOf } from "./i18n.js";
import { Live } from "./live.js";
import { settings } from "./settings.js";
import { RECONNECT, Socket } from "./socket.js";
import { refusalText, statusOf } from "./status.js";

// Each tab is a module with `mount(element, context)`, which returns what is to be done when it is left.
const TABS = ["watch", "dictionary", "teach", "review", "practise"];
const NOTICE_TIME = 6000; // [ms], long enough to read two lines
const NAMES_TIME = 1000; // [ms] for the welcome, which tells names; later the page says without them what is wrong

const element = (id) => document.getElementById(id);
const socket = new Socket();
const live = new Live(socket);
let leave = () => {};
let noticed = 0;
let named = ""; // the names in what the page says, once it says anything
let rearming = false; // asked for and not answered: while the robot brakes, the node waits for it

/** Says something once, for everybody: seen and read aloud. */
function notify(text) {
  element("notice").textContent = text;
  element("notice").hidden = false;
  clearTimeout(noticed);
  noticed = setTimeout(() => (element("notice").hidden = true), NOTICE_TIME);
}

/** Does something, and says what went wrong. */
async function attempt(action) {
  try {
    return await action();
  } catch (error) {
    notify(refusalText(error.code ?? error.name));
    return null;
  }
}

// Resolves when the page has shown its first words: reading what draws the robot would hold them up.
const painted = new Promise((resolve) => {
  new PerformanceObserver(resolve).observe({ type: "paint", buffered: true });
});

painted.then(() => document.documentElement.classList.add("painted"));

const context = {
  socket,
  live,
  api,
  t,
  settings,
  notify,
  attempt,
  /** Places the robot in an element: see robot_view.js, which is loaded when it is first wanted, and after the words. */
  robotView: async (place, options) => {
    await painted;
    return (await loaded("./robot_view.js")).robotView(place, { socket, live, t, ...options });
  },
};

/** A module of the page, as soon as it can be had: the node that serves it may just be gone. */
async function loaded(path) {
  for (let attempt = 0; ; attempt++) {
    try {
      // A browser may remember what it could not have, and not ask for it again under the same name.
      return await import(attempt ? `${path}?${attempt}` : path);
    } catch (error) {
      if (!(error instanceof TypeError)) throw error; // not the way to it is wrong, but the module
    }
    await new Promise((resolve) => setTimeout(resolve, RECONNECT));
  }
}

function tabNow() {
  const name = location.hash.slice(1).split("/")[0];
  return TABS.includes(name) ? name : "watch";
}

let mounting = 0;
async function show() {
  const name = tabNow();
  const turn = ++mounting;
  const { mount } = await loaded(`./tabs/${name}.js`);
  if (turn !== mounting) return; // another tab was chosen meanwhile
  const held = element("content").contains(document.activeElement) && document.activeElement.id;
  leave();
  leave = () => {};
  const content = element("content");
  // Of its own: a tab that another replaced while it was being made goes on writing to what is not shown.
  const page = h("div");
  content.replaceChildren(page);
  content.dataset.tab = name;
  const items = TABS.map((tab) => {
    const link = h("a", { href: `#${tab}` }, t(`tab.${tab}`));
    if (tab === name) link.setAttribute("aria-current", "page");
    return h("li", {}, link);
  });
  element("tabs").replaceChildren(...items);
  const left = (await mount(page, context)) ?? (() => {});
  if (turn !== mounting) return left();
  leave = left;
  if (held && document.activeElement === document.body) element(held)?.focus(); // the same tab, said anew
}

function showStatus() {
  if (!named) return; // there are no words yet
  const { text, tone } = statusOf(socket.connected, socket.situation);
  const status = element("status");
  if (status.textContent !== text) status.textContent = status.title = text; // else it would be read aloud again
  status.dataset.tone = tone;
  showRearm();
}

function showRearm() {
  const mode = socket.situation?.robot.mode;
  const button = element("rearm");
  button.textContent = t(rearming ? "rearming" : "rearm");
  button.setAttribute("aria-busy", String(rearming));
  button.disabled = rearming || !socket.connected || (mode !== "stopped" && mode !== "fault");
}

async function rearm() {
  const waiting = socket.situation?.queue.filter(({ current }) => !current).length;
  if (waiting && !confirm(t("rearm.starts", { count: waiting }))) return;
  rearming = true;
  showRearm();
  await attempt(() => socket.ask("command", { order: "rearm" }));
  rearming = false;
  showRearm();
  // A button that is disabled loses the focus: whoever works by keyboard goes on beside it.
  if (document.activeElement === document.body) element("stop").focus();
}

/** Says all of the page in the language chosen, with the names known. */
async function sayAll() {
  const language = settings.get("language");
  const words = await wordsOf(language);
  if (language !== settings.get("language")) return; // another was chosen meanwhile, and is on its way
  const { names } = socket.welcome;
  speak(language, words, names);
  named = JSON.stringify(names);
  const other = otherLanguage();
  element("language").textContent = other === "en" ? "English" : "Español";
  element("language").lang = other;
  showStatus();
  await show();
}

const otherLanguage = () => (settings.get("language") === "es" ? "en" : "es");

// From the start: whoever does not read the page's first language wants the other before its words are there.
element("language").addEventListener("click", () => {
  settings.set("language", otherLanguage());
  return attempt(sayAll);
});
element("stop").addEventListener("click", () => attempt(() => socket.ask("command", { order: "stop" })));
element("rearm").addEventListener("click", rearm);
document.querySelector(".skip").addEventListener("click", (event) => {
  event.preventDefault(); // the hash is the tab's
  element("content").focus();
});
window.addEventListener("hashchange", show);
for (const name of ["situation", "connection"]) socket.addEventListener(name, showStatus);
socket.addEventListener("refused", ({ detail }) => {
  rearming = false; // it does not say what was refused
  showRearm();
  notify(refusalText(detail.code));
});

/** Says all anew if the names are others: the first welcome came, another console answers, or the language changed. */
async function sayNames() {
  if (JSON.stringify(socket.welcome.names) === named) return;
  const anew = named && named !== "null";
  await sayAll();
  if (anew) notify(t("names.now"));
}
socket.addEventListener("welcome", sayNames);
setTimeout(sayNames, NAMES_TIME);
socket.connect();
