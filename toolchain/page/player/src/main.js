import uPlotStyle from 'uplot/dist/uPlot.min.css';
import style from './style.css';
import { element } from './elements.js';
import { readPageData } from './page_data.js';
import { startReplay } from './replay_page.js';

async function start() {
  document.head.append(element('style', {}, uPlotStyle, style));
  startReplay(await readPageData(document.getElementById('replay-data')), document.getElementById('player'));
}

start().catch((error) => {
  document.getElementById('player').append(
    `The page cannot be shown: ${error.message}. A current version of Firefox, Chrome, Edge or Safari shows it.`);
  throw error;
});
