// SPDX-FileCopyrightText: 2026 TEO signing project
// SPDX-License-Identifier: Apache-2.0
// JSON over /api. What is refused is thrown with its code and sentence.

export class Refused extends Error {
  constructor(code, message) {
    super(message);
    this.code = code;
  }
}

async function call(method, path, body) {
  const options = { method };
  if (body instanceof FormData || body instanceof Blob) options.body = body;
  else if (body !== undefined) {
    options.body = JSON.stringify(body);
    options.headers = { "Content-Type": "application/json" };
  }
  let response;
  try {
    response = await fetch(path, options);
  } catch {
    throw new Refused("no_console", "the console does not answer");
  }
  const json = (response.headers.get("Content-Type") ?? "").includes("json");
  const answer = json ? await response.json() : await response.text();
  if (!response.ok) throw new Refused(answer.code ?? `http_${response.status}`, answer.message ?? response.statusText);
  return answer;
}

export const api = {
  get: (path) => call("GET", path),
  post: (path, body) => call("POST", path, body ?? {}),
  delete: (path) => call("DELETE", path),
};
