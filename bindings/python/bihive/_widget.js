// The page in a cell of a notebook, by the convention of anywidget: an ES module whose render() gets the model, which Python
// shares, and an element to fill. The page is in a frame of its own; camera and pins go through a port (web/src/host.ts).
const rest_ms = 150; // of the camera before Python is told

function render({ model, el }) {
  const frame = document.createElement('iframe');
  frame.title = model.get('name');
  frame.setAttribute('sandbox', 'allow-scripts allow-downloads');
  frame.allow = 'fullscreen';
  frame.style.cssText = `width: 100vw; max-width: 100%; height: ${model.get('height')}px; border: 0`;
  // Bytes arrive as a DataView.
  frame.srcdoc = new TextDecoder().decode(model.get('page'));

  const { port1: port, port2: of_page } = new MessageChannel();
  frame.addEventListener('load', () => frame.contentWindow.postMessage({ bihive: 'port' }, '*', [of_page]), { once: true });
  let told = ''; // the camera that the page has told: it is not sent back
  let timer = 0;
  port.onmessage = ({ data }) => {
    if (data.bihive === 'camera') {
      told = JSON.stringify(data.camera);
      model.set('camera', data.camera);
      clearTimeout(timer);
      timer = setTimeout(() => model.save_changes(), rest_ms);
    } else if (data.bihive === 'pins') {
      model.set('pins', data.pins.map(({ sphere }) => sphere));
      model.set('picked', data.pins.at(-1) ?? null);
      model.save_changes();
    }
  };
  const look = () => {
    const camera = model.get('camera');
    if (camera && Object.keys(camera).length > 0 && JSON.stringify(camera) !== told) port.postMessage({ bihive: 'camera', camera });
  };
  model.on('change:camera', look);
  el.append(frame);
  return () => {
    model.off('change:camera', look);
    clearTimeout(timer);
    port.close();
  };
}

export default { render };
