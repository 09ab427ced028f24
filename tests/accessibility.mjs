// Every page of a built report in a headless browser, wide and narrow, light and dark, before the
// linter axe-core; and that no page is wider than its window. Run by `make accessibility`, which
// brings the two packages from npm.
import { readdirSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { resolve } from "node:path";
import { launch } from "./browser.mjs";

const [folder, packages] = process.argv.slice(2).map((path) => resolve(path));
const require = createRequire(`${packages}/`);
const axe = readFileSync(require.resolve("axe-core/axe.min.js"), "utf8");

let found = 0, seen = 0;
const tell = (...words) => {
  found += 1;
  console.log(...words);
};
for (const colorScheme of ["light", "dark"]) {
  const browser = await launch(packages, { dark: colorScheme === "dark" });
  for (const width of [1280, 390]) {
    // The policy of the pages lets no linter in; that they hold to it is shown by a test of its
    // own.
    const context = await browser.newContext({
      colorScheme,
      viewport: { width, height: 900 },
      bypassCSP: true,
    });
    for (const name of readdirSync(folder).filter((one) => one.endsWith(".html"))) {
      const page = await context.newPage(), where = `${name}, ${colorScheme}, ${width}:`;
      page.on("pageerror", (error) => tell(where, String(error)));
      await page.goto(`file://${folder}/${name}`);
      await page.evaluate(() => document.fonts.ready);
      const over = await page.evaluate(() =>
        document.documentElement.scrollWidth - document.documentElement.clientWidth
      );
      if (over > 0) tell(where, "wider than its window by", over);
      await page.evaluate(axe);
      for (const rule of (await page.evaluate(() => globalThis.axe.run())).violations) {
        for (const node of rule.nodes) tell(where, rule.id, node.html.slice(0, 200));
      }
      if (process.env.PICTURES) {
        await page.screenshot({
          path: `${process.env.PICTURES}/${name}-${colorScheme}-${width}.png`,
          fullPage: true,
        });
      }
      seen += 1;
      await page.close();
    }
    await context.close();
  }
  await browser.close();
}
console.log(`${folder}: ${seen} views, ${found} findings`);
process.exit(found ? 1 : 0);
