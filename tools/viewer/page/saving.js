// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One file with the page and its recorded data: the program provides the frame, and this code fills
// it.
const PLACE = 'id="saved">'; // the recorded data follows it, see page_frame.hpp

export function filledFrame(frame, items) {
  const data = JSON.stringify(items).replaceAll('<', '\\u003c');
  return frame.replace(PLACE, () => PLACE + data);
}

export async function savePage(items) {
  const answer = await fetch('frame.html');
  if (!answer.ok) throw new Error(`the program sent no page: ${answer.status}`);
  return filledFrame(await answer.text(), items);
}

export function download(name, blob) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}
