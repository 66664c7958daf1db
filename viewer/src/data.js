// The page's data: a JSON description and one base64 block of typed arrays (src/view/page_data.h writes them).
const kTypes = { f32: Float32Array, i32: Int32Array };

function bytesOf(base64) {
  const text = atob(base64.trim());
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

/**
 * Everything in the normalised frame: model = origin + scale * x. Arrays that the page lacks are null.
 * The arrays are little-endian, as every machine with a browser is.
 */
export function readData() {
  const description = JSON.parse(document.getElementById('mspskel-description').textContent);
  const block = document.getElementById('mspskel-data');
  const bytes = bytesOf(block.textContent);
  block.textContent = '';
  const data = { ...description };
  for (const name of ['skeleton_mesh', 'msp', 'slice_error', 'initial_msp', 'initial_slice_error', 'slice_normal',
    'node_of_vertex', 'part_of_vertex', 'part_of_node', 'rig_joint', 'rig_weight']) data[name] = null;
  for (const [name, { type, offset, count }] of Object.entries(description.arrays))
    data[name] = new kTypes[type](bytes.buffer, offset, count);
  return data;
}
