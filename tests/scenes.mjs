// The figures of a built report that turn, in a headless browser, opened from disk under the policy
// of its pages: Enter opens each, it looks as its still picture does, keys and a drag turn it, the
// wheel brings it nearer, 0 and Escape bring it back; the sliders of the explorer move the motion
// and the address; nothing is asked for but files of the report, and without WebGL 2 a click
// follows the link. Run by `make accessibility`, which brings the package from npm; with FRAMES=1
// it prints the frames a second of each as it turns, too, which takes 2.5 minutes more.
import { readdirSync } from "node:fs";
import { resolve } from "node:path";
import { launch } from "./browser.mjs";

const [folder, packages] = process.argv.slice(2).map((path) => resolve(path));
let asked = 0, failed = 0, turned = 0, moved = 0;
const holds = (right, ...words) => {
  asked += 1;
  if (!right) {
    failed += 1;
    console.log("not so:", ...words);
  }
};
// The mean difference of shades, of 255, from a shaded picture and from a line drawing, which has
// other tints.
const NEAR = { png: 3, svg: 15 };

const browser = await launch(packages, { gl: "soft" });
// Pictures are read in a page of their own, which has no policy; it is opened first, since a
// Firefox whose window is not in front lets Enter press no button.
const reader = await browser.newPage();
const page = await (await browser.newContext({
  viewport: { width: 1280, height: 1000 },
  reducedMotion: "reduce",
})).newPage();
page.on("pageerror", (error) => holds(false, String(error)));
page.on(
  "request",
  (request) => holds(request.url().startsWith(`file://${folder}/`), "a request to", request.url()),
);
// The panels in space as they are seen at rest, small.
const shades = async (link) => {
  await link.evaluate((one) => {
    const { viewer } = one;
    if (viewer) {
      clearTimeout(viewer.rest);
      cancelAnimationFrame(viewer.asked);
      viewer.asked = null;
      viewer.pace = 3;
      viewer.draw();
    }
  });
  const clip = await link.locator("img").boundingBox(),
    shot = (await page.screenshot({
      clip,
      style: ".scene > div, .scene button, .turns::after { visibility: hidden; } " +
        "canvas { outline: none !important; }",
    })).toString("base64");
  return reader.evaluate(async ([shot, places]) => {
    const picture = await createImageBitmap(
        await (await fetch(`data:image/png;base64,${shot}`)).blob(),
      ),
      width = 140,
      height = Math.round(140 * picture.height / picture.width),
      on = new OffscreenCanvas(width, height).getContext("2d");
    on.drawImage(picture, 0, 0, width, height);
    return places.flatMap((
      [left, top, w, h],
    ) => [...on.getImageData(left * width, top * height, w * width, h * height).data]);
  }, [shot, await link.evaluate((one) => one.places)]);
};
// Frames a second of a scene that turns for 3 s, once it has found its resolution.
const frames = (link) =>
  link.evaluate(async ({ viewer }) => {
    const turned = async (span) => {
      const start = performance.now();
      let count = 0;
      for (; performance.now() - start < span; count++) {
        viewer.turn(0.03, 0.01);
        await new Promise(requestAnimationFrame);
      }
      return 1000 * count / (performance.now() - start);
    };
    await turned(1500);
    return turned(3000);
  });
const rates = [];
const differ = (a, b) => a.reduce((sum, x, i) => sum + Math.abs(x - b[i]), 0) / a.length;
for (const name of readdirSync(folder).filter((one) => one.endsWith(".html"))) {
  await page.goto(`file://${folder}/${name}`);
  for (const link of await page.locator("a[data-scene]").all()) {
    const file = await link.getAttribute("data-scene");
    await link.scrollIntoViewIfNeeded();
    await link.focus();
    await page.keyboard.press("Enter");
    await page.waitForFunction((one) => one.viewer, await link.elementHandle(), {
      timeout: 120000,
    });
    if (process.env.FRAMES) {
      rates.push([await frames(link), file]);
      console.log(rates.at(-1)[0].toFixed(1).padStart(5), "frames a second:", file);
      await page.keyboard.press("0");
    }
    await link.evaluate((one) => {
      one.places = one.viewer.shown.places;
    });
    const home = await shades(link);
    await page.keyboard.press("Escape");
    const off = differ(home, await shades(link));
    holds(
      off < NEAR[(await link.getAttribute("href")).slice(-3)],
      file,
      "looks as its still picture does:",
      off,
    );
    if (process.env.TELL) console.log(file, off);
    await page.keyboard.press("Enter");
    await page.waitForFunction(
      (one) => one.parentElement.querySelector(".scene button"),
      await link.elementHandle(),
      { timeout: 120000 },
    );
    await page.keyboard.press("ArrowRight");
    await page.keyboard.press("ArrowDown");
    holds(differ(home, await shades(link)) > 0.2, file, "is turned by keys");
    await page.keyboard.press("0");
    holds(differ(home, await shades(link)) < 0.1, file, "comes back");
    const { x, y, width, height } = await link.locator("img").boundingBox();
    await page.mouse.move(x + 0.5 * width, y + 0.5 * height);
    await page.mouse.down();
    await page.mouse.move(x + 0.5 * width + 40, y + 0.5 * height + 15);
    await page.mouse.up();
    const dragged = await shades(link);
    holds(differ(home, dragged) > 0.2, file, "is turned by a drag");
    await page.mouse.wheel(0, -300);
    await page.waitForFunction((one) => one.viewer.zoom > 1.2, await link.elementHandle());
    holds(differ(dragged, await shades(link)) > 0.2, file, "is brought nearer by the wheel");
    await link.locator("..").locator("canvas").dispatchEvent("dblclick");
    holds(differ(home, await shades(link)) < 0.1, file, "comes back by a double click");
    await page.keyboard.press("Escape");
    holds(
      await page.evaluate(() => document.activeElement.dataset.scene) === file,
      file,
      "is closed, and its link has the focus",
    );
    turned += 1;
  }
  for (const link of await page.locator("a[data-moves]").all()) {
    const bar = page.locator(".motion", { has: page.locator("button") }).nth(moved),
      file = await link.getAttribute("data-moves"),
      out = bar.locator("output");
    holds(await out.innerText() === "", file, "stays still until it is asked to move");
    await bar.locator("input").focus();
    await page.keyboard.press("ArrowRight");
    await page.waitForFunction(
      (one) => one.textContent.startsWith("t = "),
      await out.elementHandle(),
      { timeout: 120000 },
    );
    const first = await out.innerText();
    await bar.locator("button").focus();
    await page.keyboard.press("Enter");
    await page.waitForFunction(([one, before]) => one.textContent !== before, [
      await out.elementHandle(),
      first,
    ], { timeout: 120000 });
    await page.keyboard.press("Enter");
    holds(await bar.locator("button").innerText() === "Play", file, "pauses, and keeps the focus");
    await page.keyboard.press("Escape");
    moved += 1;
  }
  moved = 0;
  await page.setViewportSize({ width: 390, height: 844 });
  for (const step of await page.locator(".film .steps > li").all()) {
    const address = await step.locator(".title a").getAttribute("href");
    const wanted = Number(new URLSearchParams(address.replace("#motion:", "")).get("omega2"));
    await step.evaluate((one) => scrollBy(0, one.getBoundingClientRect().top - 0.5 * innerHeight));
    const chosen = page.locator(".film input[type=range][name=omega2]");
    await page.waitForFunction(([one, omega2]) => Number(one.value) === omega2, [
      await chosen.elementHandle(),
      wanted,
    ], { timeout: 20000 });
    for (const place of [".film .plane", ".film .stage"]) {
      const { y, height } = await page.locator(place).boundingBox();
      holds(y >= 0 && y + height <= 0.45 * 844, name, `keeps ${place} above the step ${address}`);
    }
  }
  if (await page.locator(".film").count()) {
    await page.setViewportSize({ width: 1280, height: 1700 });
    await page.reload();
    await page.waitForTimeout(500);
    const address = await page.locator(".film .steps a").first().getAttribute("href");
    const wanted = new URLSearchParams(address.replace("#motion:", "")).get("omega3");
    const chosen = await page.locator(".film input[type=range][name=omega3]").inputValue();
    holds(Number(chosen) === Number(wanted), name, "opens a tall window with the first step");
  }
  await page.setViewportSize({ width: 1280, height: 1000 });
  await page.reload();
  const slider = page.locator(".explorer input[type=range]").first();
  if (!await slider.count()) continue;
  const said = await page.locator(".explorer output").first().innerText();
  await slider.focus();
  for (let k = 0; k < 3; k++) await page.keyboard.press("ArrowLeft");
  holds(
    await page.locator(".explorer output").first().innerText() !== said,
    name,
    "says what the slider chose",
  );
  holds(page.url().includes("#motion:"), name, "has it in its address");
  const kept = await page.locator(".explorer output").first().innerText();
  await page.reload();
  holds(
    await page.locator(".explorer output").first().innerText() === kept,
    name,
    "opens with the motion of its address",
  );
  const explorer = page.locator(".explorer:has(input[name=omega3])").first(),
    plane = explorer.locator(".plane svg:has(.pole)").first();
  if (!await plane.count()) continue;
  await plane.scrollIntoViewIfNeeded();
  const field = await plane.boundingBox(),
    at = (u, v) => [field.x + u * field.width, field.y + v * field.height];
  await page.mouse.move(...at(0.3, 0.2));
  await page.mouse.down();
  await page.mouse.move(...at(0.25, 0.7));
  await page.mouse.up();
  holds(
    (await explorer.locator("output").innerText()).startsWith("off the hyperbola"),
    name,
    "a point that is dragged off the hyperbola nutates",
  );
}
await browser.close();

const old = await launch(packages, { gl: "none" }), still = await old.newPage();
const first = readdirSync(folder).filter((one) => one.endsWith(".html"));
for (const name of first) {
  await still.goto(`file://${folder}/${name}`);
  const link = still.locator("a[data-scene]").first();
  if (!await link.count()) continue;
  const target = await link.evaluate((one) => one.href);
  await link.click();
  await still.waitForURL(target);
  holds(still.url() === target, name, "shows the still picture without WebGL 2");
  break;
}
await old.close();
if (rates.length) {
  const [rate, file] = rates.reduce((least, one) => one[0] < least[0] ? one : least);
  console.log(`${folder}: at least ${rate.toFixed(1)} frames a second, in ${file}`);
}
console.log(`${folder}: ${turned} scenes, ${asked} questions, ${failed} failures`);
process.exit(failed ? 1 : 0);
