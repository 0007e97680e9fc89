// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0
// A film of a sign: from this computer's camera, after a countdown, or from a file.

import { h } from "../dom.js";

const COUNTDOWN = 3; // [s], to take the hands down
const SECONDS = [4, 6, 10]; // lengths to choose from: one sign, a slow one, one with a repetition
// Fingers are some ten pixels wide so; more takes longer to look at and shows no more.
const CAMERA = { video: { width: { ideal: 1280 }, height: { ideal: 720 }, frameRate: { ideal: 30 }, facingMode: "user" }, audio: false };
const TYPES = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm", "video/mp4"];
const second = (count = 1) => new Promise((resolve) => setTimeout(resolve, 1000 * count));

/**
 * Makes the part with which a sign is filmed.
 * @param {Object} context The tab's; its `attempt` says what goes wrong.
 * @param {Object} options `onFilm(blob)` is called with each film; `ready()` before anybody is filmed or a film is
 *   chosen: what is still missing it says itself, and gives false; `bags` lets bags be chosen as well.
 * @returns {{element: HTMLElement, close: Function}}
 */
export function camera({ t, notify }, { onFilm, ready, bags = false }) {
  let stream = null;
  const preview = h("video", { muted: true, playsInline: true, class: "preview", "aria-label": t("camera.preview") });
  const count = h("p", { class: "count", role: "status" });
  const frame = h("div", { class: "viewfinder", hidden: true }, preview, count);
  const start = h("button", { type: "button", class: "primary", id: "camera-start", on: { click: open } }, t("camera.start"));
  const record = h("button", { type: "button", class: "primary", id: "camera-record", hidden: true, on: { click: film } }, t("camera.record"));
  const seconds = h("select", { "aria-label": t("camera.seconds") }, ...SECONDS.map((each) => h("option", { value: String(each) }, t("camera.for", { seconds: each }))));
  const file = h("input", { type: "file", accept: bags ? "video/*,.mcap" : "video/*", hidden: true, id: "film-file" });
  const choose = h("button", { type: "button", on: { click: () => ready() && file.click() } }, t(bags ? "camera.file_or_bag" : "camera.file"));
  file.addEventListener("change", () => {
    if (file.files[0]) onFilm(file.files[0]);
    file.value = ""; // the same file may be chosen again
  });
  const element = h(
    "div", { class: "camera" },
    h("p", {}, t("camera.how")),
    frame,
    h("div", { class: "row" }, start, record, seconds, file, choose),
    h("p", { class: "faint" }, t("camera.privacy")),
  );

  /** Switches the camera on; whether it is. */
  async function open() {
    if (!ready()) return false;
    try {
      stream = await navigator.mediaDevices.getUserMedia(CAMERA);
    } catch (error) {
      const known = ["NotAllowedError", "NotFoundError", "NotReadableError"].includes(error.name);
      notify(t(known ? `camera.${error.name}` : "camera.none"));
      return false;
    }
    preview.srcObject = stream;
    await preview.play();
    frame.hidden = record.hidden = false;
    start.hidden = true;
    record.focus();
    return true;
  }

  async function film() {
    if (!ready() || (!stream && !(await open()))) return; // off since the film before
    record.disabled = true;
    for (let left = COUNTDOWN; left > 0; left--) {
      count.textContent = String(left);
      await second();
    }
    if (!stream) return; // closed meanwhile
    count.textContent = t("camera.now");
    frame.classList.add("recording");
    const recorder = new MediaRecorder(stream, { mimeType: TYPES.find((type) => MediaRecorder.isTypeSupported(type)), videoBitsPerSecond: 4e6 });
    const pieces = [];
    recorder.addEventListener("dataavailable", ({ data }) => pieces.push(data));
    const stopped = new Promise((resolve) => recorder.addEventListener("stop", resolve));
    recorder.start();
    await second(Number(seconds.value));
    if (recorder.state !== "inactive") recorder.stop();
    await stopped;
    count.textContent = "";
    frame.classList.remove("recording");
    record.disabled = false;
    if (!stream) return;
    // Nobody is filmed, and no picture drawn, while this computer looks at the film.
    close();
    frame.hidden = true;
    onFilm(new Blob(pieces, { type: recorder.mimeType }));
  }

  /** Switches the camera off. */
  function close() {
    for (const track of stream?.getTracks() ?? []) track.stop();
    stream = null;
  }
  return { element, close };
}
