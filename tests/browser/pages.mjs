// Opens every page of the program in headless Chromium: phone and screen, light, dark and print.
// node pages.mjs TRUNNION SOURCE_FOLDER. Ends with 77 (skipped) where Chromium or the packages of
// package.json are not there (npm ci in this folder).
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";

const [trunnion, source] = process.argv.slice(2);
const skip = (why) => { console.log(`skipped: ${why}`); process.exit(77); };

const chromium = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"]
  .find(existsSync) ?? skip("no Chromium here");
let playwright, axe;
try {
  const require = createRequire(import.meta.url);
  playwright = require("playwright-core");
  axe = readFileSync(require.resolve("axe-core/axe.min.js"), "utf8");
} catch {
  skip("npm ci in tests/browser was not run");
}

const folder = mkdtempSync(join(tmpdir(), "trunnion_pages_"));
const page = (name) => join(folder, `${name}.html`);
const machine = (name) => join(source, "machines", name);
const program = (name) => join(source, "programs/examples", name);
const call = (...words) => {
  try {
    execFileSync(trunnion, words, { stdio: ["ignore", "ignore", "pipe"] });
  } catch (error) {
    if (error.status !== 1) throw error;  // differs, or findings
  }
};

const readings = join(folder, "readings.csv"), prints = join(folder, "prints.txt");
call("pivot", "--write-programs", join(folder, "nc"));
call("run", join(folder, "nc/O8003.nc"), "--programs", join(folder, "nc"), "--readings", readings,
     "--print", prints);
const sessions = ["monday", "friday"].map((day) => join(folder, `${day}.csv`));
call("run", "O8002", "--readings", sessions[0]);
call("run", "O8002", "--readings", sessions[1], "--inject", "C.positioning: cos2_rad=8e-5");
const instrument = (name) => join(source, "docs/instruments", name);
const positions = join(folder, "positions.csv");
call("import", "axis-log", instrument("control_log.csv"), "--setup", instrument("machine.toml"),
     "--out", positions);
const pages = {
  run: ["run", program("bracket_g43_4.nc")],
  check: ["check", join(source, "programs/examples")],
  compare: ["compare", program("bracket_g43_4.nc"), program("bracket_post.nc")],
  pivot: ["pivot"],
  ballbar: ["ballbar", "--setup", machine("ac_trunnion.toml")],
  volumetric: ["volumetric", "--setup", machine("ac_trunnion.toml")],
  compensate: ["compensate", program("bracket_g43_4.nc"), "--out", join(folder, "c.nc")],
  identify: ["identify", readings, "--setup", machine("bc_table.toml"), "--effects", "location"],
  import: ["import", "dprnt", prints, "--setup", machine("bc_table.toml"), "--out",
           join(folder, "imported.csv")],
  positions: ["import", "axis-log", instrument("control_log.csv"), "--setup",
              instrument("machine.toml"), "--out", join(folder, "positions.csv")],
  control: ["diagnose", positions, "--program", instrument("control_part.nc"), "--setup",
            instrument("machine.toml")],
  diagnose: ["diagnose", readings, "--setup", machine("bc_table.toml")],
  sessions: ["diagnose", ...sessions, "--over", "sessions", "--setup", machine("bc_table.toml")],
};
for (const [name, words] of Object.entries(pages)) call(...words, "--html", page(name));

let failed = 0;
const check = (good, text) => { if (!good) { failed += 1; console.log(`FAILED ${text}`); } };
const browser = await playwright.chromium.launch({
  executablePath: chromium,
  args: ["--no-sandbox", "--use-gl=swiftshader", "--enable-unsafe-swiftshader",
         "--disable-background-networking"],
});

async function look(name, width, scheme, media) {
  const where = `${name}, ${width} px, ${media === "print" ? "print" : scheme}`;
  const context = await browser.newContext(
    { viewport: { width, height: 900 }, colorScheme: scheme, bypassCSP: false });
  const tab = await context.newPage();
  tab.on("console", (m) => {  // the picture taken here makes the driver talk
    check(m.text().includes("GL Driver Message"), `${where}: console: ${m.text()}`);
  });
  tab.on("pageerror", (e) => check(false, `${where}: ${e.message}`));
  await tab.emulateMedia({ media, colorScheme: scheme });
  await tab.goto(`file://${page(name)}`);
  await tab.waitForTimeout(name === "run" || name === "compare" ? 1000 : 100);
  const [scroll, client] = await tab.evaluate(
    () => [document.documentElement.scrollWidth, document.documentElement.clientWidth]);
  if (media === "screen") check(scroll === client, `${where}: ${scroll} px wide in ${client}`);
  const cut = await tab.evaluate(() => [...document.querySelectorAll("figure .scroll")]
    .filter((frame) => frame.scrollWidth > frame.clientWidth).length);
  check(cut === 0, `${where}: ${cut} pictures are cut`);
  if (width === 360) await tryEnlarge(tab, where);
  if (name === "run" && media === "screen") await tryRunPage(tab, where);
  if (name === "run" && media === "print") await tryPrint(tab, where);
  await context.close();
}

/// Paper shows what the canvas keeps: its size changes, and no frame comes to draw it anew.
async function tryPrint(tab, where) {
  await tab.emulateMedia({ media: "screen" });
  await tab.waitForTimeout(300);
  await tab.evaluate(() => { globalThis.requestAnimationFrame = () => 0; });
  await tab.emulateMedia({ media: "print" });
  await tab.waitForTimeout(300);
  const colours = await tab.evaluate(() => {
    const from = document.querySelector(".stage canvas");
    const to = new OffscreenCanvas(from.width, from.height).getContext("2d");
    to.drawImage(from, 0, 0);
    const { data } = to.getImageData(0, 0, from.width, from.height);
    return new Set(new Uint32Array(data.buffer)).size;
  });
  check(colours > 30, `${where}: the printed canvas is blank (${colours} colours)`);
}

/// A touched picture has its full size, in its own frame.
async function tryEnlarge(tab, where) {
  const frame = tab.locator("figure .scroll:has(svg[width])").first();
  if (await frame.count() === 0) return;
  const [full, before] = await frame.evaluate(
    (f) => [f.firstElementChild.width.baseVal.value, f.firstElementChild.clientWidth]);
  await frame.focus();
  const after = await frame.evaluate((f) => f.firstElementChild.clientWidth);
  check(after === Math.max(before, Math.round(full)), `${where}: a touched picture is ${after} px`);
}

/// How many colours a picture has: a blank canvas has one.
async function coloursOf(context, png) {
  const tab = await context.newPage();
  const count = await tab.evaluate(async (bytes) => {
    const image = await createImageBitmap(new Blob([new Uint8Array(bytes)]));
    const canvas = new OffscreenCanvas(image.width, image.height).getContext("2d");
    canvas.drawImage(image, 0, 0);
    const { data } = canvas.getImageData(0, 0, image.width, image.height);
    return new Set(new Uint32Array(data.buffer)).size;
  }, [...png]);
  await tab.close();
  return count;
}

async function tryRunPage(tab, where) {
  const canvas = tab.locator(".stage canvas").first();
  const colours = await coloursOf(tab.context(), await canvas.screenshot());
  check(colours > 30, `${where}: the canvas is blank (${colours} colours)`);
  const row = tab.locator(".blocks .row", { hasText: "G1 " }).first();
  await row.click();
  const chosen = tab.locator(".blocks .row.chosen");
  await row.and(chosen).waitFor({ timeout: 10000 }).catch(() => {});  // a busy processor draws late
  check(await chosen.count() === 1, `${where}: a click chooses a block`);
  check((await row.getAttribute("class")).includes("chosen"), `${where}: the block clicked`);
  check(await clicksOnPath(tab, canvas, chosen) >= 2, `${where}: a click on the path, its block`);
}

/// Clicks all over the picture: how many different blocks they choose.
async function clicksOnPath(tab, canvas, chosen) {
  const blocks = new Set();
  const { x, y, width, height } = await canvas.boundingBox();
  for (let i = 1; i < 16; i += 1)
    for (let j = 1; j < 12; j += 1) {
      await tab.mouse.click(x + (width * i) / 16, y + (height * j) / 12);
      if (await chosen.count() === 1) blocks.add(await chosen.textContent());
      if (blocks.size >= 3) return blocks.size;
    }
  return blocks.size;
}

async function askAxe(name, scheme) {
  const context = await browser.newContext(
    { viewport: { width: 1440, height: 900 }, colorScheme: scheme, bypassCSP: true });
  const tab = await context.newPage();
  await tab.goto(`file://${page(name)}`);
  await tab.evaluate(axe);
  const { violations } = await tab.evaluate(() => globalThis.axe.run());
  for (const v of violations)
    check(false, `${name}, ${scheme}: axe ${v.id}: ${v.nodes[0].target.join()}`);
  await context.close();
}

for (const name of Object.keys(pages)) {
  for (const width of [360, 1440])
    for (const scheme of ["light", "dark"]) await look(name, width, scheme, "screen");
  await look(name, 794, "light", "print");
  for (const scheme of ["light", "dark"]) await askAxe(name, scheme);
}
await browser.close();
rmSync(folder, { recursive: true });
console.log(`${Object.keys(pages).length} pages, ${failed} failures`);
process.exit(failed ? 1 : 0);
