// Builds the bundles in dist/ from src/ and writes the hashes that the content policy of a page
// names. `node build.mjs --check` builds into memory and fails when dist/ is not what src/ gives.
import { build } from "esbuild";
import { createHash } from "node:crypto";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";

const check = process.argv.includes("--check");
const outputs = new Map();

for (const name of ["run", "chart"]) {
  const result = await build({
    entryPoints: [`src/${name}.js`], bundle: true, minify: true, write: false, format: "iife",
    target: "es2020", legalComments: "none", charset: "ascii",
  });
  // "</" would end the script element of a page.
  outputs.set(`dist/${name}.js`, result.outputFiles[0].text.replaceAll("</", "<\\/"));
}
const css = readFileSync("src/page.css", "utf8") +
  readFileSync("node_modules/uplot/dist/uPlot.min.css", "utf8");
outputs.set("dist/page.css", css);

const licences = ["three", "uplot"].map((name) => {
  const { version } = JSON.parse(readFileSync(`node_modules/${name}/package.json`, "utf8"));
  return `${name} ${version}\n\n${readFileSync(`node_modules/${name}/LICENSE`, "utf8").trim()}\n`;
});
outputs.set("dist/LICENSES.txt", licences.join("\n----\n\n"));

const hashes = ["run.js", "chart.js", "page.css"].map((name) => {
  const digest = createHash("sha256").update(outputs.get(`dist/${name}`)).digest("base64");
  return `${name} sha256-${digest}\n`;
});
outputs.set("dist/hashes.txt", hashes.join(""));

mkdirSync("dist", { recursive: true });
for (const [path, text] of outputs) {
  if (!check) writeFileSync(path, text);
  else if (readFileSync(path, "utf8") !== text) {
    console.error(`${path} is not what src/ gives: run npm ci && npm run build`);
    process.exitCode = 1;
  }
}
