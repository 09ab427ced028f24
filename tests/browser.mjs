// The browser in which the tests look at pages: Chromium, or the Firefox that FIREFOX names, which has WebGL 2 on a
// screen only: FIREFOX=/usr/bin/firefox-esr xvfb-run node tests/scenes.mjs ...
import { createRequire } from "node:module";

export const firefox = process.env.FIREFOX;
const CHROMIUM = { sharp: ["--enable-unsafe-swiftshader"], flat: ["--disable-webgl", "--disable-webgl2", "--disable-3d-apis"] };

// `gl` is "sharp" for WebGL 2 in software, "flat" for none.
export const launch = (packages, { gl, dark = false } = {}) => {
  const playwright = createRequire(`${packages}/`)("playwright-core");
  if (!firefox) return playwright.chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox", "--disable-gpu", ...(CHROMIUM[gl] ?? [])] });
  return playwright.firefox.launch({ channel: "moz-firefox", executablePath: firefox, firefoxUserPrefs: {
    "webgl.force-enabled": gl === "sharp", "webgl.disabled": gl === "flat", "ui.prefersReducedMotion": 1, "layout.css.prefers-color-scheme.content-override": dark ? 0 : 1,
  } });
};
