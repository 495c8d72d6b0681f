// The page beside Mol*, NGL and 3Dmol.js: a PDB file as spheres in one Chromium, each viewer as it comes and, where it has them,
// with ambient occlusion and shadows. Visits alternate. Prints JSON.
//   node viewers.mjs FILE.pdb REPETITIONS [NAME]     NAME: of those viewers alone
// Run in a folder with playwright-core, molstar, ngl and 3dmol from npm. Environment: BIHIVE, the program, which serves the page;
// CHROMIUM, the browser.
// Times: from the visit to the first picture with spheres; frames that a viewer draws per second while the scene turns for a few
// seconds, at 640 x 360; from the end of that to the last frame, when the picture is as sharp as it gets. A frame counts when
// WebGL has drawn it (gl.readPixels waits), or, of the page, when the worker says that it is on the canvas. Memory: of all of
// Chromium's processes above those of an empty page.
import { spawn } from 'node:child_process';
import { readFileSync, readdirSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { basename, join } from 'node:path';

const { chromium } = createRequire(join(process.cwd(), 'package.json'))('playwright-core');
const [pdb, repetitions] = [process.argv[2], Number(process.argv[3])];
const [width, height, turning_ms] = [640, 360, 4000];
const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];
const modules = join(process.cwd(), 'node_modules');
const version = (name) => JSON.parse(readFileSync(join(modules, name, 'package.json'))).version;

// Scripts within the pages: each sets globalThis.viewer = {shown(): Promise, turn(): Promise of one frame, rest(): Promise of ms}.
// Its context of WebGL is the last one that a script asks for.
const head = `<style>body{margin:0}</style><div id="app" style="position:relative;width:640px;height:360px"></div><script>
for (const { prototype } of [HTMLCanvasElement, OffscreenCanvas]) {
  const plain = prototype.getContext;
  prototype.getContext = function (kind, ...more) {
    const made = plain.call(this, kind, ...more);
    if (made && /webgl/.test(kind)) globalThis.last_gl = made;
    return made;
  };
}
const drawn = () => last_gl.readPixels(0, 0, 1, 1, last_gl.RGBA, last_gl.UNSIGNED_BYTE, new Uint8Array(4));
const frame = () => new Promise((done) => requestAnimationFrame(done));
</script>`;
const molstar = (soft) => `${head}<link rel="stylesheet" href="/molstar.css"><script src="/molstar.js"></script><script>
(async () => {
  const made = await molstar.Viewer.create('app', { layoutShowControls: false, layoutIsExpanded: false, viewportShowExpand: false, layoutShowSequence: false });
  await made.loadStructureFromUrl('/m.pdb', 'pdb', false);
  const { plugin } = made;
  const { component, hierarchy } = plugin.managers.structure;
  for (const structure of hierarchy.current.structures)
    for (const one of structure.components) { await component.removeRepresentations([one]); await component.addRepresentation([one], 'spacefill'); }
  const canvas = plugin.canvas3d;
  const on = ${soft};
  const off = { name: 'off', params: {} };
  canvas.setProps({ postprocessing: on
    ? { occlusion: { name: 'on', params: { samples: 32, radius: 5, bias: 0.8, blurKernelSize: 15, blurDepthBias: 0.5, resolutionScale: 1, color: 0, transparentThreshold: 0.4, multiScale: off } }, shadow: { name: 'on', params: { steps: 1, maxDistance: 3, tolerance: 1 } } }
    : { occlusion: off, shadow: off } });
  while (!(canvas.reprCount.value > 0 && canvas.boundingSphereVisible.radius > 5)) await frame();
  canvas.requestCameraReset({ durationMs: 0 });
  let last = 0;
  canvas.didDraw.subscribe(() => (last = performance.now()));
  globalThis.viewer = {
    shown: async () => { const from = performance.now(); while (last < from) { canvas.requestDraw(); await frame(); } drawn(); return performance.now(); },
    turn: async () => {
      const before = last;
      const { position, target, up } = canvas.camera.state;
      const [x, y, z] = [0, 1, 2].map((i) => position[i] - target[i]);
      const [c, s] = [Math.cos(0.05), Math.sin(0.05)];
      canvas.camera.setState({ position: [target[0] + c * x + s * z, target[1] + y, target[2] - s * x + c * z], up }, 0);
      while (last === before) { canvas.requestDraw(); await frame(); }
      drawn();
    },
    rest: async () => { const from = performance.now(); for (let calm = 0; calm < 30; ) { const before = last; await frame(); calm = last === before ? calm + 1 : 0; } drawn(); return Math.max(0, last - from); },
  };
})();</script>`;
const ngl = `${head}<script src="/ngl.js"></script><script>
(async () => {
  const stage = new NGL.Stage('app');
  const part = await stage.loadFile('/m.pdb', { defaultRepresentation: false });
  part.addRepresentation('spacefill');
  part.autoView();
  const one = () => { stage.viewer.render(); drawn(); };
  globalThis.viewer = {
    shown: async () => { await frame(); one(); return performance.now(); },
    turn: async () => { await frame(); stage.viewerControls.spin([0, 1, 0], 0.05); one(); },
    rest: async () => { const from = performance.now(); await frame(); one(); return performance.now() - from; },
  };
})();</script>`;
const threedmol = (soft) => `${head}<script src="/3dmol.js"></script><script>
(async () => {
  const made = $3Dmol.createViewer('app', ${soft ? "{ ambientOcclusion: { strength: 1.0, radius: 5 } }" : '{}'});
  made.addModel(await (await fetch('/m.pdb')).text(), 'pdb');
  made.setStyle({}, { sphere: {} });
  made.zoomTo();
  const one = () => { made.render(); drawn(); };
  globalThis.viewer = {
    shown: async () => { await frame(); one(); return performance.now(); },
    turn: async () => { await frame(); made.rotate(3, 'y'); one(); },
    rest: async () => { const from = performance.now(); await frame(); one(); return performance.now() - from; },
  };
})();</script>`;

const pages = { '/molstar': molstar(false), '/molstar-soft': molstar(true), '/ngl': ngl, '/3dmol': threedmol(false), '/3dmol-soft': threedmol(true), '/empty': head };
const files = {
  '/m.pdb': pdb, '/molstar.js': join(modules, 'molstar/build/viewer/molstar.js'), '/molstar.css': join(modules, 'molstar/build/viewer/molstar.css'),
  '/ngl.js': join(modules, 'ngl/dist/ngl.js'), '/3dmol.js': join(modules, '3dmol/build/3Dmol-min.js'),
};
const server = createServer((request, response) => {
  const path = new URL(request.url, 'http://x').pathname;
  const type = path.endsWith('.js') ? 'text/javascript' : path.endsWith('.css') ? 'text/css' : path === '/m.pdb' ? 'text/plain' : 'text/html';
  if (!(path in pages) && !(path in files)) return response.writeHead(404).end();
  response.writeHead(200, { 'content-type': type }).end(pages[path] ?? readFileSync(files[path]));
}).listen(0);
const peers = `http://127.0.0.1:${server.address().port}`;
const program = spawn(process.env.BIHIVE, ['web', pdb, '--port', '0', '--no-browser', '--json'], { stdio: ['ignore', 'pipe', 'inherit'] });
const page_url = JSON.parse(await new Promise((take) => program.stdout.once('data', (data) => take(String(data))))).url;
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM,
  args: ['--no-sandbox', '--disable-dev-shm-usage', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'],
});

// The share of memory that is a process's own, of this browser's processes.
function memory_mb() {
  const all = readdirSync('/proc').filter((name) => /^\d+$/.test(name)).map((name) => {
    try {
      return { pid: Number(name), parent: Number(readFileSync(`/proc/${name}/stat`, 'utf8').replace(/.*\) \S /, '').split(' ')[0]) };
    } catch {
      return { pid: 0, parent: 0 };
    }
  });
  const ours = new Set([process.pid]);
  for (let found = -1; found !== ours.size; ) {
    found = ours.size;
    for (const { pid, parent } of all) if (ours.has(parent) && pid !== program.pid) ours.add(pid);
  }
  ours.delete(process.pid);
  let kb = 0;
  for (const pid of ours) {
    try {
      kb += Number(/^Pss:\s+(\d+)/m.exec(readFileSync(`/proc/${pid}/smaps_rollup`, 'utf8'))[1]);
    } catch {
      // it has ended
    }
  }
  return kb / 1024;
}

async function open(url, script) {
  const context = await browser.newContext({ viewport: { width, height } });
  const page = await context.newPage();
  page.setDefaultTimeout(300_000);
  if (script) await page.addInitScript(script);
  await page.goto(url, { waitUntil: 'commit' });
  return { context, page };
}

async function peer(name) {
  const { context, page } = await open(`${peers}/${name}`);
  await page.waitForFunction(() => globalThis.viewer);
  const first_picture_ms = await page.evaluate(() => globalThis.viewer.shown());
  await page.evaluate(() => globalThis.viewer.rest());
  const turned = await page.evaluate(async (ms) => {
    await globalThis.viewer.turn();
    const from = performance.now();
    let frames = 0;
    for (; performance.now() < from + ms; ++frames) await globalThis.viewer.turn();
    return { frames_per_second: (1000 * frames) / (performance.now() - from), sharp_ms: await globalThis.viewer.rest() };
  }, turning_ms);
  return { context, first_picture_ms, ...turned, divisor: 1 };
}

// The page: frames are what its worker says.
const watch_worker = () => {
  globalThis.frames = [];
  const { Worker } = globalThis;
  globalThis.Worker = class extends Worker {
    constructor(...of) {
      super(...of);
      this.addEventListener('message', ({ data }) => {
        if (data.type === 'frame') globalThis.frames.push({ ...data.report, at: performance.now() });
      });
    }
  };
};
async function ours(query) {
  const { context, page } = await open(`${page_url}${query}`, watch_worker);
  await page.waitForSelector('#picture[data-settled=true]');
  const first_picture_ms = await page.evaluate(() => performance.getEntriesByName('first picture')[0].startTime);
  const turned = await page.evaluate(async (ms) => {
    const picture = document.getElementById('picture');
    picture.focus();
    const frame = () => new Promise((done) => requestAnimationFrame(done));
    const key = () => document.activeElement.dispatchEvent(new KeyboardEvent('keydown', { key: 'ArrowLeft', bubbles: true }));
    for (const end = performance.now() + 1000; performance.now() < end; ) { key(); await frame(); }
    const from = performance.now();
    while (performance.now() < from + ms) { key(); await frame(); }
    const to = performance.now();
    const moving = globalThis.frames.filter(({ at, drawn }) => drawn && at >= from && at < to);
    const settled = () => globalThis.frames.find(({ at, settled }) => settled && at > to);
    while (!settled()) await frame();
    const sizes = moving.map(({ divisor }) => divisor).sort((a, b) => a - b);
    const whole = globalThis.frames.find(({ at, drawn, divisor, done }) => drawn && at > to && divisor === 1);
    return { frames_per_second: (1000 * moving.length) / ms, divisor: sizes[sizes.length >> 1], sharp_ms: whole ? whole.at - to : null, complete_ms: settled().at - to };
  }, turning_ms);
  return { context, first_picture_ms, ...turned };
}

const kinds = {
  'bihive': () => ours('?embed'), 'Mol*': () => peer('molstar'), 'Mol*, occlusion and shadows': () => peer('molstar-soft'),
  'NGL': () => peer('ngl'), '3Dmol.js': () => peer('3dmol'), '3Dmol.js, occlusion': () => peer('3dmol-soft'),
};
const chosen = process.argv[4] ? Object.entries(kinds).filter(([name]) => name.includes(process.argv[4])) : Object.entries(kinds);
const empty = await open(`${peers}/empty`);
const without_mb = memory_mb();
await empty.context.close();
const results = Object.fromEntries(chosen.map(([name]) => [name, []]));
for (let i = 0; i < repetitions; ++i)
  for (const [name, visit] of chosen) {
    const { context, ...numbers } = await visit();
    results[name].push({ ...numbers, memory_mb: memory_mb() - without_mb });
    await context.close();
    await new Promise((done) => setTimeout(done, 500));
  }
const medians = (runs) => Object.fromEntries(Object.keys(runs[0]).map((key) => [key, median(runs.map((run) => run[key]))]));
console.log(JSON.stringify({
  chromium: browser.version(), file: basename(pdb), molstar: version('molstar'), ngl: version('ngl'), '3dmol': version('3dmol'), size: [width, height], repetitions,
  medians: Object.fromEntries(Object.entries(results).map(([name, runs]) => [name, medians(runs)])), runs: results,
}, null, 1));
await browser.close();
program.kill('SIGINT');
server.close();
