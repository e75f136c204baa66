// The page of a run: the machine moves along the program, the path shows where the physical tip
// leaves the believed one.
import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { BlockList } from "./blocks.js";
import { pageData, unpacked } from "./data.js";
import { lineChart } from "./line_chart.js";
import { MachineModel, tableModel, toolModel } from "./machine.js";

const stops = [[0, [0.27, 0.0, 0.33]], [0.25, [0.23, 0.32, 0.55]], [0.5, [0.13, 0.57, 0.55]],
  [0.75, [0.37, 0.79, 0.38]], [1, [0.99, 0.91, 0.15]]];  // viridis, dark is small

function heat(part) {
  let k = 1;
  while (k < stops.length - 1 && part > stops[k][0]) ++k;
  const [a, low] = stops[k - 1], [b, high] = stops[k];
  const t = Math.min(1, Math.max(0, (part - a) / (b - a)));
  return low.map((v, i) => v + t * (high[i] - v));
}

/** As tables print it: three significant digits, whole numbers in full. */
function threeDigits(value) {
  if (value < 0.0005) return "0";
  return value.toFixed(Math.max(0, 2 - Math.floor(Math.log10(value))));
}

function element(id) { return document.getElementById(id); }

async function main() {
  const data = pageData();
  const columns = await unpacked(data.path);
  const { count } = data.path;
  const names = data.machine.axes.map((a) => a.name);
  const axisAt = (i) => Object.fromEntries(names.map((n) => [n, columns[n]?.[i] ?? 0]));

  const renderer = new THREE.WebGLRenderer({ antialias: true, alpha: true,
    preserveDrawingBuffer: true });  // a printed page shows what was drawn
  renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
  const stage = element("stage");
  stage.append(renderer.domElement);
  renderer.domElement.setAttribute("role", "img");
  renderer.domElement.setAttribute("aria-label", "Machine and tool path");
  const scene = new THREE.Scene();
  scene.add(new THREE.HemisphereLight(0xffffff, 0x8090a0, 2.4));
  const camera = new THREE.PerspectiveCamera(35, 1, 1, 1e5);
  camera.up.set(0, 0, 1);

  const box = new THREE.Box3();
  for (let i = 0; i < count; ++i)
    box.expandByPoint(new THREE.Vector3(columns.tip_x[i], columns.tip_y[i], columns.tip_z[i]));
  const size = Math.max(60, box.getSize(new THREE.Vector3()).length());
  const scale = Math.max(size, 150) * 1.6;
  const model = new MachineModel(data.machine, scale, {
    tool: new THREE.Vector3(0, scale * 0.35, scale * 0.35),
    work: new THREE.Vector3(0, 0, -scale * 0.3),
  });
  const table = tableModel(Math.max(size * 0.75, 60));
  table.position.z = Math.min(box.min.z, 0) - size * 0.05;
  model.table.add(table);
  scene.add(model.root);
  let tool = null, toolShown = -1;

  // The path hangs on the table; its points are the physical tip, the deviation exaggerated.
  const positions = new Float32Array(count * 3), colours = new Float32Array(count * 3);
  const path = new THREE.BufferGeometry();
  path.setAttribute("position", new THREE.BufferAttribute(positions, 3));
  path.setAttribute("color", new THREE.BufferAttribute(colours, 3));
  const line = new THREE.Line(path, new THREE.LineBasicMaterial({ vertexColors: true }));
  line.frustumCulled = false;
  model.table.add(line);
  const deviation = new Float64Array(count);
  // Rapids do not cut, and behind G49 the control believes in no tool: the scale is that of feeds.
  const counts = columns.feed.some((v) => v > 0) ? (i) => columns.feed[i] > 0 : () => true;
  let largest = 0;
  for (let i = 0; i < count; ++i) {
    deviation[i] = 1000 * Math.hypot(columns.dev_x[i], columns.dev_y[i], columns.dev_z[i]);
    if (counts(i)) largest = Math.max(largest, deviation[i]);
  }
  for (let i = 0; i < count; ++i)
    colours.set(heat(largest > 0 ? Math.min(1, deviation[i] / largest) : 0), 3 * i);

  function exaggerate(factor) {
    for (let i = 0; i < count; ++i) {
      positions[3 * i] = columns.tip_x[i] + factor * columns.dev_x[i];
      positions[3 * i + 1] = columns.tip_y[i] + factor * columns.dev_y[i];
      positions[3 * i + 2] = columns.tip_z[i] + factor * columns.dev_z[i];
    }
    path.attributes.position.needsUpdate = true;
    path.computeBoundingSphere();
  }

  const chosenLine = new THREE.Line(new THREE.BufferGeometry(),
    new THREE.LineBasicMaterial({ color: 0xd55e00, depthTest: false }));
  chosenLine.renderOrder = 2;
  chosenLine.frustumCulled = false;
  model.table.add(chosenLine);

  // rowOf: row of the list for each point; several programs stand one after the other.
  const lines = [], firstRow = [];
  for (const program of data.programs) {
    firstRow.push(lines.length);
    const at = lines.length + program.first;
    lines.length += program.count;
    program.lines.forEach((line, k) => { lines[at + k] = line; });
  }
  const rowOf = (i) => firstRow[columns.program[i]] + columns.line[i] - 1;
  const pointsOfRow = new Map();
  for (let i = 0; i < count; ++i) {
    const row = rowOf(i), range = pointsOfRow.get(row);
    if (!range) pointsOfRow.set(row, [i, i]);
    else if (range[1] === i - 1) range[1] = i;
  }

  const slider = element("time");
  slider.max = String(count - 1);
  let at = 0, playing = false, lastFrame = 0, clock = 0;

  function shape() {
    const [first, last] = pointsOfRow.get(rowOf(at)) ?? [at, at];
    const from = Math.max(0, first - 1);
    chosenLine.geometry.dispose();
    chosenLine.geometry = new THREE.BufferGeometry();
    chosenLine.geometry.setAttribute("position",
      new THREE.BufferAttribute(positions.slice(3 * from, 3 * (last + 1)), 3));
  }

  function show(i, fromList = false) {
    at = Math.min(count - 1, Math.max(0, i));
    clock = columns.time[at];
    slider.value = String(at);
    const where = axisAt(at);
    model.move(where);
    if (columns.tool[at] !== toolShown) {
      toolShown = columns.tool[at];
      if (tool) model.spindle.remove(tool);
      tool = toolModel(data.tools[toolShown] ?? [0, 0, -100], Math.max(2, size * 0.012));
      model.spindle.add(tool);
    }
    shape();
    blocks.choose(rowOf(at), fromList);
    const ofKind = (kind, text) => data.machine.axes.filter((a) => a.kind === kind)
      .map((a) => `${a.name} ${text(where[a.name])}`);
    const linear = ofKind("linear", (v) => v.toFixed(3)).join(" ");
    const rotary = ofKind("rotary", (v) => `${(v * 180 / Math.PI).toFixed(3)}°`).join(" ");
    element("place").textContent = [`${columns.time[at].toFixed(1)} s`, linear && `${linear} mm`,
      rotary, `deviation ${threeDigits(deviation[at])} µm`].filter(Boolean).join(" · ");
    draw();
  }

  const blocks = new BlockList(element("blocks"), lines, (row) => {
    let best = null;
    for (let r = row; r >= 0 && best === null; --r) best = pointsOfRow.get(r)?.[1] ?? null;
    if (best !== null) show(best, true);
    blocks.choose(row);
  });

  const controls = new OrbitControls(camera, renderer.domElement);
  const drawNow = () => renderer.render(scene, camera);
  const draw = () => requestAnimationFrame(drawNow);
  controls.addEventListener("change", draw);
  function look() {
    const centre = box.getCenter(new THREE.Vector3());
    controls.target.copy(centre);
    camera.position.copy(centre).add(new THREE.Vector3(1.1, -1.9, 1.2).multiplyScalar(size * 1.25));
    controls.update();
    draw();
  }
  new ResizeObserver(() => {
    renderer.setSize(stage.clientWidth, stage.clientHeight, false);
    camera.aspect = stage.clientWidth / Math.max(1, stage.clientHeight);
    camera.updateProjectionMatrix();
    drawNow();  // a new size blanks the canvas, and paper has no next frame
  }).observe(stage);

  // A click picks the nearest point of the path on the screen.
  let pressed = null;
  renderer.domElement.addEventListener("pointerdown", (e) => { pressed = [e.clientX, e.clientY]; });
  renderer.domElement.addEventListener("pointerup", (e) => {
    if (!pressed || Math.hypot(e.clientX - pressed[0], e.clientY - pressed[1]) > 4) return;
    const frame = renderer.domElement.getBoundingClientRect();
    const matrix = new THREE.Matrix4().multiplyMatrices(camera.projectionMatrix,
      camera.matrixWorldInverse).multiply(model.table.matrixWorld);
    const p = new THREE.Vector3();
    let best = -1, nearest = 24;
    for (let i = 0; i < count; ++i) {
      p.fromArray(positions, 3 * i).applyMatrix4(matrix);
      const x = frame.left + (p.x + 1) / 2 * frame.width, y = frame.top + (1 - p.y) / 2 * frame.height;
      const off = Math.hypot(x - e.clientX, y - e.clientY);
      if (off < nearest && p.z < 1) { nearest = off; best = i; }
    }
    if (best >= 0) show(best);
  });

  slider.addEventListener("input", () => show(Number(slider.value)));
  const exaggeration = element("exaggeration");
  const setFactor = () => {
    const factor = Math.round(10 ** Number(exaggeration.value));
    element("factor").textContent = `${factor} ×`;
    exaggerate(factor);
    shape();
    draw();
  };
  exaggeration.addEventListener("input", setFactor);
  element("play").addEventListener("click", () => {
    playing = !playing;
    element("play").textContent = playing ? "Pause" : "Play";
    if (playing && at === count - 1) show(0);
    lastFrame = 0;
    if (playing) requestAnimationFrame(frameStep);
  });
  element("home").addEventListener("click", look);
  const speed = Math.max(1, columns.time[count - 1] / 30);  // the whole run in half a minute
  function frameStep(now) {
    if (!playing) return;
    if (lastFrame) {
      clock += (now - lastFrame) / 1000 * speed;
      let i = at;
      while (i < count - 1 && columns.time[i] < clock) ++i;
      const kept = clock;
      if (i !== at) show(i);
      clock = kept;
      if (i === count - 1) { playing = false; element("play").textContent = "Play"; return; }
    }
    lastFrame = now;
    requestAnimationFrame(frameStep);
  }

  setFactor();
  look();
  show(Math.max(0, data.start ?? 0));
  lineChart(element("chart"), {
    x: { label: "time, s", values: columns.time },
    y: { label: "deviation, µm" },
    series: [{ label: "deviation while feeding, µm",
      values: Array.from(deviation, (v, i) => (counts(i) ? v : null)) }],
    onPoint: (i) => show(i),
  });
  document.documentElement.dataset.ready = "yes";
}

main().catch((error) => {
  element("place").textContent = `The view cannot start: ${error.message}`;
  document.documentElement.dataset.ready = "failed";
});
