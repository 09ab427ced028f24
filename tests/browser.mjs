// The browser in which the tests look at pages: Chromium, or the Firefox that FIREFOX names.
// Firefox has WebGL 2 on a screen only. Playwright asks for commands that Firefox has since 143;
// 1.64 and later for one that stable ones don't have.     FIREFOX=/usr/bin/firefox-esr xvfb-run -a
// node tests/scenes.mjs build/report/atlas build/accessibility
import { createRequire } from "node:module";

const firefox = process.env.FIREFOX;
const SWITCHES = {
  soft: ["--enable-unsafe-swiftshader"],
  none: ["--disable-webgl", "--disable-webgl2", "--disable-3d-apis"],
};

// `gl` is "soft" for WebGL 2 in software, "none" for no WebGL; `touch` is for a telephone, which
// Firefox can't be by page.
export const launch = (packages, { gl, dark = false, touch = false } = {}) => {
  const playwright = createRequire(`${packages}/`)("playwright-core");
  if (!firefox) {
    return playwright.chromium.launch({
      executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
      args: ["--no-sandbox", "--disable-gpu", ...(SWITCHES[gl] ?? [])],
    });
  }
  return playwright.firefox.launch({
    channel: "moz-firefox",
    executablePath: firefox,
    firefoxUserPrefs: {
      "webgl.force-enabled": gl === "soft",
      "webgl.disabled": gl === "none",
      "ui.prefersReducedMotion": 1,
      "layout.css.prefers-color-scheme.content-override": dark ? 0 : 1,
      ...(touch ? { "ui.primaryPointerCapabilities": 1, "ui.allPointerCapabilities": 1 } : {}),
    },
  });
};
