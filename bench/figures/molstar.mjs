// Spheres of a PDB file by Mol*, in a headless Chromium whose WebGL is software: without and with its ambient occlusion and shadows.
// node bench/figures/molstar.mjs MODULES FILE.pdb OUT writes OUT-sharp.png and OUT-soft.png. MODULES: the folder in which
// `npm install molstar puppeteer-core` was run. Environment: CHROMIUM, the browser.
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { join, resolve } from 'node:path';

const [modules, pdb, out] = process.argv.slice(2);
const { default: puppeteer } = await import(createRequire(resolve(modules, 'x.js')).resolve('puppeteer-core'));
const [width, height] = [640, 480];
const viewer = join(modules, 'node_modules/molstar/build/viewer');
const files = new Map([['/m.pdb', pdb], ['/molstar.js', join(viewer, 'molstar.js')], ['/molstar.css', join(viewer, 'molstar.css')]]);
const page_text = `<link rel="stylesheet" href="molstar.css"><div id="app" style="position:absolute;width:${width}px;height:${height}px"></div>
<script src="molstar.js"></script>`;

const server = createServer((request, response) => {
  const path = files.get(request.url);
  const type = request.url === '/' ? 'text/html' : request.url.endsWith('.css') ? 'text/css' : 'text/javascript';
  if (request.url !== '/' && !(path && existsSync(path))) return response.writeHead(404).end();
  response.writeHead(200, { 'content-type': type }).end(path ? readFileSync(path) : page_text);
}).listen(0);

const browser = await puppeteer.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  protocolTimeout: 600_000,
  args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'],
  defaultViewport: { width, height },
});
const page = await browser.newPage();
await page.goto(`http://localhost:${server.address().port}/`);
const pictures = await page.evaluate(async (width, height) => {
  const pause = (ms) => new Promise((done) => setTimeout(done, ms));
  const viewer = await globalThis.molstar.Viewer.create('app', { layoutShowControls: false, layoutIsExpanded: false, viewportShowExpand: false });
  await viewer.loadStructureFromUrl('/m.pdb', 'pdb', false);
  const { plugin } = viewer;
  const { component, hierarchy } = plugin.managers.structure;
  for (const structure of hierarchy.current.structures)
    for (const one of structure.components) {
      await component.removeRepresentations([one]);
      await component.addRepresentation([one], 'spacefill');
    }
  const canvas = plugin.canvas3d;
  while (!(canvas.reprCount.value > 0 && canvas.boundingSphereVisible.radius > 10)) await pause(200);
  await pause(2000);
  canvas.requestCameraReset({ durationMs: 0 });
  await pause(3000);

  const off = { name: 'off', params: {} };
  const occlusion = { samples: 32, radius: 5, bias: 0.8, blurKernelSize: 15, blurDepthBias: 0.5, resolutionScale: 1, color: 0, transparentThreshold: 0.4, multiScale: off };
  const shadow = { steps: 1, maxDistance: 3, tolerance: 1 };
  const uris = {};
  for (const kind of ['sharp', 'soft']) {
    const soft = kind === 'soft';
    canvas.setProps({ postprocessing: { occlusion: soft ? { name: 'on', params: occlusion } : off, shadow: soft ? { name: 'on', params: shadow } : off } });
    await pause(3000);
    const shot = plugin.helpers.viewportScreenshot;
    shot.behaviors.values.next({ ...shot.values, resolution: { name: 'custom', params: { width, height } }, axes: off });
    uris[kind] = await shot.getImageDataUri();
  }
  return uris;
}, width, height);
for (const [kind, uri] of Object.entries(pictures)) writeFileSync(`${out}-${kind}.png`, Buffer.from(uri.split(',')[1], 'base64'));
await browser.close();
server.close();
