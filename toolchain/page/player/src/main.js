import uPlotStyle from 'uplot/dist/uPlot.min.css';
import style from './style.css';
import { element } from './elements.js';
import { startLive } from './live/live_page.js';
import liveStyle from './live/live.css';
import { readPageData } from './page_data.js';
import { startReplay } from './replay_page.js';

async function start() {
  document.head.append(element('style', {}, uPlotStyle, style, liveStyle));
  const root = document.getElementById('player');
  const live = document.getElementById('live-data');
  if (live) startLive(await readPageData(live), root);
  else startReplay(await readPageData(document.getElementById('replay-data')), root);
}

start().catch((error) => {
  document.getElementById('player').append(
    `The page cannot be shown: ${error.message}. A current version of Firefox, Chrome, Edge or Safari shows it.`);
  throw error;
});
