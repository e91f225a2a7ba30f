// SPDX-License-Identifier: MIT
// The pictures of the examples that the page greets with, drawn by the page itself: node thumbnails.mjs FOLDER.
// scripts/studio_pictures calls it.
import { readdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { closing, frame, launch, openPage, until } from './browser.mjs';
import { RealStudio } from './real_studio.mjs';

const folder = process.argv[2], size = { width: 846, height: 480, quality: 'high' };

await closing(async (keep) => {
  const studio = keep(await RealStudio.start(null)), browser = keep(await launch());
  const page = await openPage(browser, studio.url, size);
  await until(page, '(s) => s.connected === "open" && s.document');
  await page.evaluate(() => globalThis.carom.store.set({ panel: false }));
  await frame(page);
  for (const file of readdirSync(join(studio.folder, 'scenes')).filter((name) => name.endsWith('.json')).sort()) {
    await page.evaluate(([path]) => globalThis.carom.connection.request('open', { path, gallery: true, replace: true }), [file]);
    await until(page, `(s) => s.document?.suggested === "${file.replace('.json', '-copy.json')}" && s.motion`, 120000);
    // as a person sees it who has played half of it
    await page.evaluate(() => {
      const { store } = globalThis.carom;
      store.set({ time: store.state.motion.end / 2 });
    });
    await page.mouse.move(2, 2);
    await frame(page);
    const picture = await page.evaluate(() => {
      const small = document.createElement('canvas'), pen = small.getContext('2d'), layers = document.querySelectorAll('#view > canvas');
      [small.width, small.height] = [276, 120];
      pen.imageSmoothingQuality = 'high';
      globalThis.carom.redraw();  // what WebGL drew is there until the end of this task
      for (const layer of layers) pen.drawImage(layer, 0, 0, small.width, small.height);
      return small.toDataURL('image/png').split(',')[1];
    });
    writeFileSync(join(folder, file.replace(/json$/, 'png')), Buffer.from(picture, 'base64'));
  }
});
