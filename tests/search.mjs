// The search box of a built report in headless Chromium, opened from disk under the policy of its
// pages: what is found for letters, formulas, numbers and slips, in this report and in the one
// beside it; arrows, Enter and Escape; and on a telephone a tap on an equation's number. Run by
// `make accessibility`, which brings the package from npm.
import { existsSync } from "node:fs";
import { resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { launch } from "./browser.mjs";

const [folder, other, packages] = process.argv.slice(2).map((path) => resolve(path));
const browser = await launch(packages);
let asked = 0, failed = 0;
const holds = (right, ...words) => {
  asked += 1;
  if (!right) {
    failed += 1;
    console.log("not so:", ...words);
  }
};
const open = async (browser, options) => {
  const page = await (await browser.newContext(options)).newPage();
  page.on("pageerror", (error) => holds(false, String(error)));
  page.on("console", (message) => holds(message.type() !== "error", message.text()));
  await page.goto(`file://${folder}/index.html`);
  return page;
};
const hits = async (page, query) => {
  await page.fill("#search", "");
  await page.waitForFunction(() => document.querySelector("#results").hidden);
  await page.fill("#search", query);
  await page.waitForFunction(() => !document.querySelector("#results").hidden);
  return page.$$eval(
    "#results a",
    (links) =>
      links.map((link) => ({ href: link.href, title: link.querySelector("b").textContent })),
  );
};
const focused = (page) =>
  page.evaluate(() => document.activeElement.href ?? document.activeElement.id);

const page = await open(browser, { viewport: { width: 1280, height: 900 } });
const box = await page.locator("#search").boundingBox();
holds(box.y + box.height < 900, "the search box is on the first screen");
if (folder.endsWith("/guide")) {
  const meant = {
    quaternion: /quaternion/i,
    quaterion: /quaternion/i,
    precesion: /precession/i,
    uncertainty: /Uncertainties/,
    action: /actions/,
    thread: /threads/,
    jax: /jax/,
    "type hints": /type hints/,
    density: /A body of one/,
    "proof of equation 48": /ledger/,
    asteroid: /asteroid/,
    TopMotion: /^atlas.TopMotion\(/,
  };
  for (const [query, title] of Object.entries(meant)) {
    holds(
      (await hits(page, query)).slice(0, 2).some((hit) => title.test(hit.title)),
      query,
      "is found first or second",
    );
  }
  await browser.close();
  console.log(`${folder}: ${asked} questions, ${failed} failures`);
  process.exit(failed ? 1 : 0);
}
for (
  const query of [
    "I=3/2",
    "I = 3/2",
    "omega2",
    "ω2",
    "Ω3",
    "g-factor",
    "(72)",
    "precession",
    "preccession",
    "Clebsch",
    "Euler-Poisson equations",
    "sqrt(1-I)",
    "how do I draw a figure",
    "equation 72",
    "quaternion",
    "quaternoin",
    "uncertainty",
    "action",
    "thread",
    "jax",
    "type hints",
    "density",
    "proof of equation 48",
  ]
) {
  const found = await hits(page, query);
  holds(found.length > 0, query, "is found");
  for (const { href } of found) {
    const file = fileURLToPath(href.split("#")[0]);
    holds(existsSync(file), query, "leads to a page that is there:", href);
  }
}
for (const query of ["equation 72", "eq. 72", "(72)", "72"]) {
  holds((await hits(page, query))[0].title.includes("(72)"), query, "is that equation first");
}
const across = (await hits(page, "slips found in the paper")).filter(({ href }) =>
  href.startsWith(`file://${other}/`)
);
holds(across.length > 0, "what only the other volume has is found");
holds(across.every(({ title }) => title.includes(": ")), "and its volume is named");
holds(
  (await hits(page, "hyperbola"))[0].href.startsWith(`file://${folder}/`),
  "this report's own come first",
);
holds(
  (await hits(page, "zzzzqqq")).length === 0 &&
    await page.locator("#results").innerText() === "Nothing found.",
  "nothing is said to be nothing",
);

const found = await hits(page, "quadric");
await page.focus("#search");
for (const place of [0, 1, 2]) {
  await page.keyboard.press("ArrowDown");
  holds(await focused(page) === found[place].href, "arrow down goes to result", place);
}
for (const place of [1, 0]) {
  await page.keyboard.press("ArrowUp");
  holds(await focused(page) === found[place].href, "arrow up goes to result", place);
}
await page.keyboard.press("ArrowUp");
holds(await focused(page) === "search", "and back to the box");
await page.keyboard.press("Escape");
holds(await page.locator("#results").isHidden(), "Escape closes the results");
await hits(page, "quadric");
await page.keyboard.press("ArrowDown");
await page.keyboard.press("ArrowDown");
await page.keyboard.press("Enter");
await page.waitForURL(found[1].href);
await page.goto(`file://${folder}/index.html`);
const [first] = await hits(page, "(72)");
await page.keyboard.press("Enter");
await page.waitForURL(first.href);
await page.keyboard.press("/");
holds(await focused(page) === "search", "a slash goes to the box");

const away = await hits(page, "slips found in the paper");
await page.locator(`#results a[href*="${across[0].href.split("/").at(-2)}/"]`).first().click();
await page.waitForURL((url) => url.href.startsWith(`file://${other}/`));
holds(away.length > 0, "a result of the other volume opens there");

// A telephone: no hover, so that a tap shows the equation and a second one goes to it.
// Playwright cannot touch Firefox.
const tap = (one, at) => process.env.FIREFOX ? one.click(at) : one.tap(at);
const touched = await launch(packages, { touch: true });
const phone = await open(touched, {
  viewport: { width: 390, height: 844 },
  hasTouch: true,
  isMobile: true,
});
const link = phone.locator('main a[href*="#eq-"]').first();
await link.scrollIntoViewIfNeeded();
const before = phone.url();
await tap(link);
await phone.waitForSelector("#shown:not([hidden])");
holds(await phone.locator("#shown math").count() > 0, "a tap shows the equation");
holds(phone.url() === before, "and stays on the page");
const shown = await phone.locator("#shown").boundingBox();
holds(shown.x >= 0 && shown.x + shown.width <= 390, "within the screen");
const target = await link.evaluate((one) => one.href);
await tap(phone.locator("#shown a", { hasText: "Go there" }));
await phone.waitForURL(target);
holds(await phone.locator("#shown").isHidden(), "the equation goes when its link is followed");
await phone.goto(before);
await tap(link);
await phone.waitForSelector("#shown:not([hidden])");
await phone.locator("#shown").evaluate(() => document.activeElement.blur());
holds(await phone.locator("#shown").isVisible(), "what was tapped stays");
await tap(phone.locator("main p").first(), { position: { x: 2, y: 2 } });
holds(await phone.locator("#shown").isHidden(), "a tap elsewhere closes it");
await tap(link);
await phone.waitForSelector("#shown:not([hidden])");
await tap(link);
await phone.waitForURL(target);

await browser.close();
await touched.close();
console.log(`${folder}: ${asked} questions, ${failed} failures`);
process.exit(failed ? 1 : 0);
