/*!
three.js

The MIT License

Copyright © 2010-2026 three.js authors

Permission is hereby granted, free of charge, to any person obtaining a copy
of this software and associated documentation files (the "Software"), to deal
in the Software without restriction, including without limitation the rights
to use, copy, modify, merge, publish, distribute, sublicense, and/or sell
copies of the Software, and to permit persons to whom the Software is
furnished to do so, subject to the following conditions:

The above copyright notice and this permission notice shall be included in
all copies or substantial portions of the Software.

THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR
IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY,
FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE
AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER
LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM,
OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN
THE SOFTWARE.

three-mesh-bvh

MIT License

Copyright (c) 2018 Garrett Johnson

Permission is hereby granted, free of charge, to any person obtaining a copy
of this software and associated documentation files (the "Software"), to deal
in the Software without restriction, including without limitation the rights
to use, copy, modify, merge, publish, distribute, sublicense, and/or sell
copies of the Software, and to permit persons to whom the Software is
furnished to do so, subject to the following conditions:

The above copyright notice and this permission notice shall be included in all
copies or substantial portions of the Software.

THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR
IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY,
FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE
AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER
LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM,
OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE
SOFTWARE.

uPlot

The MIT License (MIT)

Copyright (c) 2022 Leon Sorokin

Permission is hereby granted, free of charge, to any person obtaining a copy
of this software and associated documentation files (the "Software"), to deal
in the Software without restriction, including without limitation the rights
to use, copy, modify, merge, publish, distribute, sublicense, and/or sell
copies of the Software, and to permit persons to whom the Software is
furnished to do so, subject to the following conditions:

The above copyright notice and this permission notice shall be included in
all copies or substantial portions of the Software.

THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR
IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY,
FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE
AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER
LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM,
OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN
THE SOFTWARE.
*/
(()=>{var Vm='.uplot, .uplot *, .uplot *::before, .uplot *::after {box-sizing: border-box;}.uplot {font-family: system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, "Noto Sans", sans-serif, "Apple Color Emoji", "Segoe UI Emoji", "Segoe UI Symbol", "Noto Color Emoji";line-height: 1.5;width: min-content;}.u-title {text-align: center;font-size: 18px;font-weight: bold;}.u-wrap {position: relative;user-select: none;}.u-over, .u-under {position: absolute;}.u-under {overflow: hidden;}.uplot canvas {display: block;position: relative;width: 100%;height: 100%;}.u-axis {position: absolute;}.u-legend {font-size: 14px;margin: auto;text-align: center;}.u-inline {display: block;}.u-inline * {display: inline-block;}.u-inline tr {margin-right: 16px;}.u-legend th {font-weight: 600;}.u-legend th > * {vertical-align: middle;display: inline-block;}.u-legend .u-marker {width: 1em;height: 1em;margin-right: 4px;background-clip: padding-box !important;}.u-inline.u-live th::after {content: ":";vertical-align: middle;}.u-inline:not(.u-live) .u-value {display: none;}.u-series > * {padding: 4px;}.u-series th {cursor: pointer;}.u-legend .u-off > * {opacity: 0.3;}.u-select {background: rgba(0,0,0,0.07);position: absolute;pointer-events: none;}.u-cursor-x, .u-cursor-y {position: absolute;left: 0;top: 0;pointer-events: none;will-change: transform;}.u-hz .u-cursor-x, .u-vt .u-cursor-y {height: 100%;border-right: 1px dashed #607D8B;}.u-hz .u-cursor-y, .u-vt .u-cursor-x {width: 100%;border-bottom: 1px dashed #607D8B;}.u-cursor-pt {position: absolute;top: 0;left: 0;border-radius: 50%;border: 0 solid;pointer-events: none;will-change: transform;/*this has to be !important since we set inline "background" shorthand */background-clip: padding-box !important;}.u-axis.u-off, .u-select.u-off, .u-cursor-x.u-off, .u-cursor-y.u-off, .u-cursor-pt.u-off {display: none;}';var Gm=`:root {
  --ground: #f6f7f9; --panel: #fff; --view: linear-gradient(#fdfdfe, #e6e9ee); --text: #1b1f27; --muted: #5d6675;
  --line: #e1e5eb; --accent: #2563eb;
  --free: #8b95a5; --contact: #1f8f60; --cut: #c27803; --start-inside: #a855f7; --overflow: #ea580c;
  --infeasible: #db2777; --bad-input: #dc2626;
  color-scheme: light;
}
:root[data-theme='dark'] {
  --ground: #12151b; --panel: #1a1f28; --view: linear-gradient(#232a36, #141820); --text: #e8ebf0; --muted: #9aa4b5;
  --line: #2c3442; --accent: #60a5fa; --free: #596475;
  color-scheme: dark;
}
* { box-sizing: border-box; }
body { margin: 0; background: var(--ground); color: var(--text); font: 15px/1.45 system-ui, sans-serif; }
header { padding: 14px 16px 10px; }
h1 { margin: 0; font-size: 20px; line-height: 1.3; overflow-wrap: anywhere; }
.lead { margin: 2px 0 0; color: var(--muted); max-width: 130ch; }
#player { display: grid; gap: 12px; padding: 0 16px 16px; grid-template-columns: minmax(0, 1fr); background: var(--ground); }
.frame, .plot { background: var(--panel); border: 1px solid var(--line); border-radius: 10px; overflow: hidden; margin: 0; }
.frame { display: flex; flex-direction: column; min-width: 0; }
.view { position: relative; flex: 1; min-height: 340px; background: var(--view); }
.picture { position: absolute; inset: 0; width: 100%; height: 100%; display: block; touch-action: none; cursor: grab; }
.picture:active { cursor: grabbing; }
.message { position: absolute; inset: 0; margin: auto; height: fit-content; max-width: 44ch; padding: 16px; text-align: center; }
.labels { position: absolute; inset: 0; pointer-events: none; }
.labels.alone { position: static; padding: 8px; }
.labels.alone .label { position: static; }
.label { position: absolute; display: flex; flex-wrap: wrap; gap: 2px 8px; align-items: center; font-size: 13px;
  padding: 3px 9px; border-radius: 8px; background: color-mix(in srgb, var(--panel) 82%, transparent); }
.label .name { font-weight: 600; overflow-wrap: anywhere; }
.label .name::before { content: ''; display: inline-block; width: 10px; height: 10px; margin-right: 6px; border-radius: 3px;
  background: var(--colour); }
.state { padding: 0 8px; border-radius: 9px; background: var(--state); color: #fff; font-size: 12px; font-weight: 600; }
.words { color: var(--muted); }
.keys { position: absolute; left: 8px; bottom: 8px; display: flex; flex-wrap: wrap; gap: 2px 12px; padding: 3px 9px;
  border-radius: 8px; font-size: 12px; color: var(--muted); pointer-events: none;
  background: color-mix(in srgb, var(--panel) 82%, transparent); max-width: calc(100% - 16px); }
.key { display: inline-flex; align-items: center; white-space: nowrap; }
.key::before { content: ''; box-sizing: border-box; flex: none; width: 10px; height: 10px; margin-right: 5px; border-radius: 3px; }
.key.hand::before { background: #f59e0b99; border: 1px solid #b45309; }
.key.god-object::before { background: #3b82f6; }
.by-distance .key.god-object::before { background: var(--scale); }
.key.force::before { background: #e11d48; height: 4px; width: 14px; }
.key.torque::before { border: 2px solid #16a34a; border-left-color: transparent; border-radius: 50%; width: 12px; height: 12px; }
.key.workspace::before { border: 1px solid #f59e0b; }
.key.grid::before { border: 1px solid var(--muted); border-radius: 0; }
.transport, .options { display: flex; align-items: center; gap: 8px; padding: 8px 10px; border-top: 1px solid var(--line); }
.options { flex-wrap: wrap; gap: 6px 14px; font-size: 13px; padding: 6px 10px; min-height: 46px; }
.options .right { margin-left: auto; display: flex; gap: 6px; }
.options .details { display: flex; flex-wrap: wrap; align-items: center; gap: 6px 10px; }
.options .details[hidden] { display: none; }
.details input[type='range'] { width: 130px; }
.legend { display: flex; align-items: center; gap: 14px; padding-right: 34px; }
.legend[hidden] { display: none; }
.scale { position: relative; width: 190px; height: 28px; }
.scale::before { content: ''; position: absolute; inset: 0 0 auto; height: 11px; border-radius: 3px; background: var(--scale); }
.scale span { position: absolute; top: 12px; transform: translateX(-50%); font-size: 12px; line-height: 16px; white-space: nowrap;
  color: var(--muted); font-variant-numeric: tabular-nums; }
.sides { color: var(--muted); }
.inside-mark { display: inline-flex; align-items: center; }
.inside-mark::before { content: ''; width: 11px; height: 11px; margin-right: 5px; border-radius: 3px;
  background: var(--inside); }
.place { min-width: 62px; text-align: right; font-variant-numeric: tabular-nums; }
label { white-space: nowrap; display: inline-flex; align-items: center; gap: 5px; }
input { accent-color: var(--accent); margin: 0; }
button, select { height: 32px; border: 1px solid var(--line); border-radius: 8px; background: var(--panel);
  color: var(--text); font: inherit; font-size: 13px; cursor: pointer; }
button { width: 34px; padding: 0; display: inline-grid; place-items: center; flex: none; }
button:hover, select:hover { border-color: var(--accent); }
button.on { color: var(--accent); border-color: var(--accent); }
button svg { width: 18px; height: 18px; fill: currentcolor; }
button.play { background: var(--accent); border-color: var(--accent); color: #fff; width: 42px; }
:root[data-theme='dark'] button.play { color: #0b1220; }
:focus-visible { outline: 2px solid var(--accent); outline-offset: 1px; }
.track { flex: 1; min-width: 60px; display: grid; gap: 3px; }
.track input { width: 100%; height: 16px; }
.band { width: 100%; height: 8px; border-radius: 3px; display: block; }
.several .band { height: 14px; }
.times { font-variant-numeric: tabular-nums; font-size: 13px; white-space: nowrap; }
.end { color: var(--muted); }
.plots { display: grid; gap: 10px; grid-template-columns: minmax(0, 1fr); align-content: start; }
.plot { display: flex; flex-direction: column; padding: 6px 4px 0 8px; min-width: 0; }
.plot-head { display: flex; flex-wrap: wrap; align-items: baseline; gap: 0 8px; font-size: 13px; }
.plot-name { font-weight: 600; margin-right: auto; }
.value { font-variant-numeric: tabular-nums; color: var(--text); }
.value::before { content: ''; display: inline-block; width: 8px; height: 8px; margin-right: 4px; border-radius: 2px;
  background: var(--colour); }
.value.inside { color: #dc2626; font-weight: 600; }
:root[data-theme='dark'] .value.inside { color: #f87171; }
.unit { color: var(--muted); min-width: 30px; padding-right: 8px; }
.plot-box { height: 112px; min-width: 0; }
.plot .u-over { cursor: crosshair; touch-action: pan-y; }
.now { position: absolute; top: 0; bottom: 0; left: 0; width: 0; border-left: 1.5px solid var(--text); pointer-events: none; }
@media (min-width: 1000px) {
  .view { min-height: 300px; }
  #player:not(.several) { grid-template-columns: minmax(0, 1.55fr) minmax(0, 1fr); }
  #player:not(.several) .plots { grid-auto-rows: minmax(118px, 1fr); align-content: stretch; height: max(756px, calc(100vh - 105px)); }
  #player:not(.several) .plot-box { flex: 1; height: 0; }
  .several .view { height: max(380px, calc(100vh - 500px)); flex: none; }
  .several .plots { grid-template-columns: repeat(3, minmax(0, 1fr)); }
}
@media (min-width: 640px) and (max-width: 999px) {
  .view { height: 56vh; flex: none; }
  .plots { grid-template-columns: repeat(2, minmax(0, 1fr)); }
}
@media (max-width: 639px) {
  header { padding: 10px 12px 8px; }
  h1 { font-size: 18px; }
  .lead { font-size: 14px; }
  #player { padding: 0 8px 12px; gap: 8px; }
  .view { height: 62vh; flex: none; }
  .several .view { height: min(86vh, calc(var(--count) * 235px + 60px)); }
  .several .words { display: none; }
  .transport { flex-wrap: wrap; }
  .transport .track { order: -1; flex-basis: 100%; }
  .times { margin-left: auto; }
  .plot-box { height: 104px; }
}
#player:fullscreen { overflow: auto; padding: 12px; }
@media (min-width: 1000px) {
  #player:fullscreen:not(.several) .plots { height: max(756px, calc(100vh - 24px)); }
}
`;function yr(i,t){let e=i.toFixed(t);return Number(e)===0?0 .toFixed(t):e}function mt(i,t={},...e){let n=document.createElement(i);for(let[s,r]of Object.entries(t))s.includes("-")?n.setAttribute(s,r):n[s]=r;return n.append(...e),n}/**
 * @license
 * Copyright 2010-2026 Three.js Authors
 * SPDX-License-Identifier: MIT
 */var ir={LEFT:0,MIDDLE:1,RIGHT:2,ROTATE:0,DOLLY:1,PAN:2},sr={ROTATE:0,PAN:1,DOLLY_PAN:2,DOLLY_ROTATE:3},Mg=0,sd=1,bg=2;var il=1,wg=2,Lo=3,Mi=0,Cn=1,$n=2,Er=0,Do=1,rd=2,od=3,ad=4,Tg=5;var Cr=100,Ag=101,Eg=102,Cg=103,Rg=104,Pg=200,Ig=201,Lg=202,Dg=203,ld=204,cd=205,Ng=206,Ug=207,Fg=208,Og=209,Bg=210,zg=211,kg=212,Vg=213,Gg=214,pc=0,mc=1,gc=2,Js=3,_c=4,xc=5,vo=6,yc=7,hd=0,Hg=1,Wg=2,hs=0,ud=1,fd=2,dd=3,pd=4,md=5,gd=6,_d=7;var xd=300,Rr=301,No=302,Xc=303,qc=304,vc=1e3,rs=1001,Sc=1002,Vn=1003,Xg=1004;var sl=1005;var si=1006,Yc=1007;var Ns=1008;var hi=1009,yd=1010,vd=1011,Uo=1012,Zc=1013,Hi=1014,ui=1015,Wi=1016,$c=1017,Kc=1018,Pr=1020,Sd=35902,Md=35899,bd=1021,wd=1022,Xi=1023,Rs=1026,Us=1027,Fo=1028,Jc=1029,rr=1030,jc=1031;var Qc=1033,rl=33776,ol=33777,al=33778,ll=33779,th=35840,eh=35841,nh=35842,ih=35843,sh=36196,rh=37492,oh=37496,ah=37488,lh=37489,cl=37490,ch=37491,hh=37808,uh=37809,fh=37810,dh=37811,ph=37812,mh=37813,gh=37814,_h=37815,xh=37816,yh=37817,vh=37818,Sh=37819,Mh=37820,bh=37821,wh=36492,Th=36494,Ah=36495,Eh=36283,Ch=36284,hl=36285,Rh=36286;var Da=2300,Mc=2301,fc=2302,Kf=2303,Jf=2400,jf=2401,Qf=2402;var qg=3200;var Ph=0,Yg=1,Fs="",yi="srgb",Na="srgb-linear",Ua="linear",Re="srgb";var dc=7680,or=7681;var Td=34055,Ad=34056;var Ed=514;var Oo=517;var Ih=519,Zg=512,$g=513,Kg=514,Cd=515,Jg=516,jg=517,Rd=518,Pd=519,Qg=35044;var Id="300 es",Ii=2e3,So=2001;function Qy(i){for(let t=i.length-1;t>=0;--t)if(i[t]>=65535)return!0;return!1}function tv(i){return ArrayBuffer.isView(i)&&!(i instanceof DataView)}function Fa(i){return document.createElementNS("http://www.w3.org/1999/xhtml",i)}function t0(){let i=Fa("canvas");return i.style.display="block",i}var Hm={},Mo=null;function Ld(...i){let t="THREE."+i.shift();Mo?Mo("log",t,...i):console.log(t,...i)}function e0(i){let t=i[0];if(typeof t=="string"&&t.startsWith("TSL:")){let e=i[1];e&&e.isStackTrace?i[0]+=" "+e.getLocation():i[1]='Stack trace not available. Enable "THREE.Node.captureStackTrace" to capture stack traces.'}return i}function Yt(...i){i=e0(i);let t="THREE."+i.shift();if(Mo)Mo("warn",t,...i);else{let e=i[0];e&&e.isStackTrace?console.warn(e.getError(t)):console.warn(t,...i)}}function Qt(...i){i=e0(i);let t="THREE."+i.shift();if(Mo)Mo("error",t,...i);else{let e=i[0];e&&e.isStackTrace?console.error(e.getError(t)):console.error(t,...i)}}function Pa(...i){let t=i.join(" ");t in Hm||(Hm[t]=!0,Yt(...i))}function n0(i,t,e){return new Promise(function(n,s){function r(){switch(i.clientWaitSync(t,i.SYNC_FLUSH_COMMANDS_BIT,0)){case i.WAIT_FAILED:s();break;case i.TIMEOUT_EXPIRED:setTimeout(r,e);break;default:n()}}setTimeout(r,e)})}var i0={[pc]:pc,[gc]:vo,[_c]:_c,[Js]:xc,[mc]:mc,[vo]:gc,[yc]:yc,[xc]:Js},Vi=class{addEventListener(t,e){this._listeners===void 0&&(this._listeners={});let n=this._listeners;n[t]===void 0&&(n[t]=[]),n[t].indexOf(e)===-1&&n[t].push(e)}hasEventListener(t,e){let n=this._listeners;return n===void 0?!1:n[t]!==void 0&&n[t].indexOf(e)!==-1}removeEventListener(t,e){let n=this._listeners;if(n===void 0)return;let s=n[t];if(s!==void 0){let r=s.indexOf(e);r!==-1&&s.splice(r,1)}}dispatchEvent(t){let e=this._listeners;if(e===void 0)return;let n=e[t.type];if(n!==void 0){t.target=this;let s=n.slice(0);for(let r=0,o=s.length;r<o;r++)s[r].call(this,t);t.target=null}}},Yn=["00","01","02","03","04","05","06","07","08","09","0a","0b","0c","0d","0e","0f","10","11","12","13","14","15","16","17","18","19","1a","1b","1c","1d","1e","1f","20","21","22","23","24","25","26","27","28","29","2a","2b","2c","2d","2e","2f","30","31","32","33","34","35","36","37","38","39","3a","3b","3c","3d","3e","3f","40","41","42","43","44","45","46","47","48","49","4a","4b","4c","4d","4e","4f","50","51","52","53","54","55","56","57","58","59","5a","5b","5c","5d","5e","5f","60","61","62","63","64","65","66","67","68","69","6a","6b","6c","6d","6e","6f","70","71","72","73","74","75","76","77","78","79","7a","7b","7c","7d","7e","7f","80","81","82","83","84","85","86","87","88","89","8a","8b","8c","8d","8e","8f","90","91","92","93","94","95","96","97","98","99","9a","9b","9c","9d","9e","9f","a0","a1","a2","a3","a4","a5","a6","a7","a8","a9","aa","ab","ac","ad","ae","af","b0","b1","b2","b3","b4","b5","b6","b7","b8","b9","ba","bb","bc","bd","be","bf","c0","c1","c2","c3","c4","c5","c6","c7","c8","c9","ca","cb","cc","cd","ce","cf","d0","d1","d2","d3","d4","d5","d6","d7","d8","d9","da","db","dc","dd","de","df","e0","e1","e2","e3","e4","e5","e6","e7","e8","e9","ea","eb","ec","ed","ee","ef","f0","f1","f2","f3","f4","f5","f6","f7","f8","f9","fa","fb","fc","fd","fe","ff"],Wm=1234567,Ia=Math.PI/180,bo=180/Math.PI;function Bo(){let i=Math.random()*4294967295|0,t=Math.random()*4294967295|0,e=Math.random()*4294967295|0,n=Math.random()*4294967295|0;return(Yn[i&255]+Yn[i>>8&255]+Yn[i>>16&255]+Yn[i>>24&255]+"-"+Yn[t&255]+Yn[t>>8&255]+"-"+Yn[t>>16&15|64]+Yn[t>>24&255]+"-"+Yn[e&63|128]+Yn[e>>8&255]+"-"+Yn[e>>16&255]+Yn[e>>24&255]+Yn[n&255]+Yn[n>>8&255]+Yn[n>>16&255]+Yn[n>>24&255]).toLowerCase()}function ae(i,t,e){return Math.max(t,Math.min(e,i))}function Dd(i,t){return(i%t+t)%t}function ev(i,t,e,n,s){return n+(i-t)*(s-n)/(e-t)}function nv(i,t,e){return i!==t?(e-i)/(t-i):0}function La(i,t,e){return(1-e)*i+e*t}function iv(i,t,e,n){return La(i,t,1-Math.exp(-e*n))}function sv(i,t=1){return t-Math.abs(Dd(i,t*2)-t)}function rv(i,t,e){return i<=t?0:i>=e?1:(i=(i-t)/(e-t),i*i*(3-2*i))}function ov(i,t,e){return i<=t?0:i>=e?1:(i=(i-t)/(e-t),i*i*i*(i*(i*6-15)+10))}function av(i,t){return i+Math.floor(Math.random()*(t-i+1))}function lv(i,t){return i+Math.random()*(t-i)}function cv(i){return i*(.5-Math.random())}function hv(i){i!==void 0&&(Wm=i);let t=Wm+=1831565813;return t=Math.imul(t^t>>>15,t|1),t^=t+Math.imul(t^t>>>7,t|61),((t^t>>>14)>>>0)/4294967296}function uv(i){return i*Ia}function fv(i){return i*bo}function dv(i){return i>0&&Number.isInteger(i)&&2**Math.round(Math.log2(i))===i}function pv(i){return Math.pow(2,Math.ceil(Math.log(i)/Math.LN2))}function Nd(i){return Math.pow(2,Math.floor(Math.log(i)/Math.LN2))}function mv(i,t,e,n,s){let r=Math.cos,o=Math.sin,a=r(e/2),l=o(e/2),c=r((t+n)/2),f=o((t+n)/2),u=r((t-n)/2),h=o((t-n)/2),d=r((n-t)/2),g=o((n-t)/2);switch(s){case"XYX":i.set(a*f,l*u,l*h,a*c);break;case"YZY":i.set(l*h,a*f,l*u,a*c);break;case"ZXZ":i.set(l*u,l*h,a*f,a*c);break;case"XZX":i.set(a*f,l*g,l*d,a*c);break;case"YXY":i.set(l*d,a*f,l*g,a*c);break;case"ZYZ":i.set(l*g,l*d,a*f,a*c);break;default:Yt("MathUtils: .setQuaternionFromProperEuler() encountered an unknown order: "+s)}}function Ud(i){switch(i.constructor){case Uint32Array:return 4294967295;case Uint16Array:return 65535;case Uint8Array:case Uint8ClampedArray:return 255;case Int32Array:return 2147483647;case Int16Array:return 32767;case Int8Array:return 127;default:return}}function s0(i,t){if(t.constructor===Float32Array)return i;let e=Ud(t);if(e===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.max(i/e,-1)}function r0(i,t){if(t.constructor===Float32Array)return i;let e=Ud(t);if(e===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.round(i*e)}var Fd={DEG2RAD:Ia,RAD2DEG:bo,generateUUID:Bo,clamp:ae,euclideanModulo:Dd,mapLinear:ev,inverseLerp:nv,lerp:La,damp:iv,pingpong:sv,smoothstep:rv,smootherstep:ov,randInt:av,randFloat:lv,randFloatSpread:cv,seededRandom:hv,degToRad:uv,radToDeg:fv,isPowerOfTwo:dv,ceilPowerOfTwo:pv,floorPowerOfTwo:Nd,setQuaternionFromProperEuler:mv,normalize:r0,denormalize:s0},Vd=class Vd{constructor(t=0,e=0){this.x=t,this.y=e}get width(){return this.x}set width(t){this.x=t}get height(){return this.y}set height(t){this.y=t}set(t,e){return this.x=t,this.y=e,this}setScalar(t){return this.x=t,this.y=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;default:throw new Error("THREE.Vector2: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;default:throw new Error("THREE.Vector2: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y)}copy(t){return this.x=t.x,this.y=t.y,this}add(t){return this.x+=t.x,this.y+=t.y,this}addScalar(t){return this.x+=t,this.y+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this}subScalar(t){return this.x-=t,this.y-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this}multiply(t){return this.x*=t.x,this.y*=t.y,this}multiplyScalar(t){return this.x*=t,this.y*=t,this}divide(t){return this.x/=t.x,this.y/=t.y,this}divideScalar(t){return this.multiplyScalar(1/t)}applyMatrix3(t){let e=this.x,n=this.y,s=t.elements;return this.x=s[0]*e+s[3]*n+s[6],this.y=s[1]*e+s[4]*n+s[7],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this}clamp(t,e){return this.x=ae(this.x,t.x,e.x),this.y=ae(this.y,t.y,e.y),this}clampScalar(t,e){return this.x=ae(this.x,t,e),this.y=ae(this.y,t,e),this}clampLength(t,e){let n=this.length();return this.divideScalar(n||1).multiplyScalar(ae(n,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this}negate(){return this.x=-this.x,this.y=-this.y,this}dot(t){return this.x*t.x+this.y*t.y}cross(t){return this.x*t.y-this.y*t.x}lengthSq(){return this.x*this.x+this.y*this.y}length(){return Math.sqrt(this.x*this.x+this.y*this.y)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)}normalize(){return this.divideScalar(this.length()||1)}angle(){return Math.atan2(-this.y,-this.x)+Math.PI}angleTo(t){let e=Math.sqrt(this.lengthSq()*t.lengthSq());if(e===0)return Math.PI/2;let n=this.dot(t)/e;return Math.acos(ae(n,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){let e=this.x-t.x,n=this.y-t.y;return e*e+n*n}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this}lerpVectors(t,e,n){return this.x=t.x+(e.x-t.x)*n,this.y=t.y+(e.y-t.y)*n,this}equals(t){return t.x===this.x&&t.y===this.y}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this}rotateAround(t,e){let n=Math.cos(e),s=Math.sin(e),r=this.x-t.x,o=this.y-t.y;return this.x=r*n-o*s+t.x,this.y=r*s+o*n+t.y,this}random(){return this.x=Math.random(),this.y=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y}};Vd.prototype.isVector2=!0;var kt=Vd,en=class{constructor(t=0,e=0,n=0,s=1){this.isQuaternion=!0,this._x=t,this._y=e,this._z=n,this._w=s}static slerpFlat(t,e,n,s,r,o,a){let l=n[s+0],c=n[s+1],f=n[s+2],u=n[s+3],h=r[o+0],d=r[o+1],g=r[o+2],v=r[o+3];if(u!==v||l!==h||c!==d||f!==g){let m=l*h+c*d+f*g+u*v;m<0&&(h=-h,d=-d,g=-g,v=-v,m=-m);let p=1-a;if(m<.9995){let _=Math.acos(m),M=Math.sin(_);p=Math.sin(p*_)/M,a=Math.sin(a*_)/M,l=l*p+h*a,c=c*p+d*a,f=f*p+g*a,u=u*p+v*a}else{l=l*p+h*a,c=c*p+d*a,f=f*p+g*a,u=u*p+v*a;let _=1/Math.sqrt(l*l+c*c+f*f+u*u);l*=_,c*=_,f*=_,u*=_}}t[e]=l,t[e+1]=c,t[e+2]=f,t[e+3]=u}static multiplyQuaternionsFlat(t,e,n,s,r,o){let a=n[s],l=n[s+1],c=n[s+2],f=n[s+3],u=r[o],h=r[o+1],d=r[o+2],g=r[o+3];return t[e]=a*g+f*u+l*d-c*h,t[e+1]=l*g+f*h+c*u-a*d,t[e+2]=c*g+f*d+a*h-l*u,t[e+3]=f*g-a*u-l*h-c*d,t}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get w(){return this._w}set w(t){this._w=t,this._onChangeCallback()}set(t,e,n,s){return this._x=t,this._y=e,this._z=n,this._w=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._w)}copy(t){return this._x=t.x,this._y=t.y,this._z=t.z,this._w=t.w,this._onChangeCallback(),this}setFromEuler(t,e=!0){let n=t._x,s=t._y,r=t._z,o=t._order,a=Math.cos,l=Math.sin,c=a(n/2),f=a(s/2),u=a(r/2),h=l(n/2),d=l(s/2),g=l(r/2);switch(o){case"XYZ":this._x=h*f*u+c*d*g,this._y=c*d*u-h*f*g,this._z=c*f*g+h*d*u,this._w=c*f*u-h*d*g;break;case"YXZ":this._x=h*f*u+c*d*g,this._y=c*d*u-h*f*g,this._z=c*f*g-h*d*u,this._w=c*f*u+h*d*g;break;case"ZXY":this._x=h*f*u-c*d*g,this._y=c*d*u+h*f*g,this._z=c*f*g+h*d*u,this._w=c*f*u-h*d*g;break;case"ZYX":this._x=h*f*u-c*d*g,this._y=c*d*u+h*f*g,this._z=c*f*g-h*d*u,this._w=c*f*u+h*d*g;break;case"YZX":this._x=h*f*u+c*d*g,this._y=c*d*u+h*f*g,this._z=c*f*g-h*d*u,this._w=c*f*u-h*d*g;break;case"XZY":this._x=h*f*u-c*d*g,this._y=c*d*u-h*f*g,this._z=c*f*g+h*d*u,this._w=c*f*u+h*d*g;break;default:Yt("Quaternion: .setFromEuler() encountered an unknown order: "+o)}return e===!0&&this._onChangeCallback(),this}setFromAxisAngle(t,e){let n=e/2,s=Math.sin(n);return this._x=t.x*s,this._y=t.y*s,this._z=t.z*s,this._w=Math.cos(n),this._onChangeCallback(),this}setFromRotationMatrix(t){let e=t.elements,n=e[0],s=e[4],r=e[8],o=e[1],a=e[5],l=e[9],c=e[2],f=e[6],u=e[10],h=n+a+u;if(h>0){let d=.5/Math.sqrt(h+1);this._w=.25/d,this._x=(f-l)*d,this._y=(r-c)*d,this._z=(o-s)*d}else if(n>a&&n>u){let d=2*Math.sqrt(1+n-a-u);this._w=(f-l)/d,this._x=.25*d,this._y=(s+o)/d,this._z=(r+c)/d}else if(a>u){let d=2*Math.sqrt(1+a-n-u);this._w=(r-c)/d,this._x=(s+o)/d,this._y=.25*d,this._z=(l+f)/d}else{let d=2*Math.sqrt(1+u-n-a);this._w=(o-s)/d,this._x=(r+c)/d,this._y=(l+f)/d,this._z=.25*d}return this._onChangeCallback(),this}setFromUnitVectors(t,e){let n=t.dot(e)+1;return n<1e-8?(n=0,Math.abs(t.x)>Math.abs(t.z)?(this._x=-t.y,this._y=t.x,this._z=0,this._w=n):(this._x=0,this._y=-t.z,this._z=t.y,this._w=n)):(this._x=t.y*e.z-t.z*e.y,this._y=t.z*e.x-t.x*e.z,this._z=t.x*e.y-t.y*e.x,this._w=n),this.normalize()}angleTo(t){return 2*Math.acos(Math.abs(ae(this.dot(t),-1,1)))}rotateTowards(t,e){let n=this.angleTo(t);if(n===0)return this;let s=Math.min(1,e/n);return this.slerp(t,s),this}identity(){return this.set(0,0,0,1)}invert(){return this.conjugate()}conjugate(){return this._x*=-1,this._y*=-1,this._z*=-1,this._onChangeCallback(),this}dot(t){return this._x*t._x+this._y*t._y+this._z*t._z+this._w*t._w}lengthSq(){return this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w}length(){return Math.sqrt(this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w)}normalize(){let t=this.length();return t===0?(this._x=0,this._y=0,this._z=0,this._w=1):(t=1/t,this._x=this._x*t,this._y=this._y*t,this._z=this._z*t,this._w=this._w*t),this._onChangeCallback(),this}multiply(t){return this.multiplyQuaternions(this,t)}premultiply(t){return this.multiplyQuaternions(t,this)}multiplyQuaternions(t,e){let n=t._x,s=t._y,r=t._z,o=t._w,a=e._x,l=e._y,c=e._z,f=e._w;return this._x=n*f+o*a+s*c-r*l,this._y=s*f+o*l+r*a-n*c,this._z=r*f+o*c+n*l-s*a,this._w=o*f-n*a-s*l-r*c,this._onChangeCallback(),this}slerp(t,e){let n=t._x,s=t._y,r=t._z,o=t._w,a=this.dot(t);a<0&&(n=-n,s=-s,r=-r,o=-o,a=-a);let l=1-e;if(a<.9995){let c=Math.acos(a),f=Math.sin(c);l=Math.sin(l*c)/f,e=Math.sin(e*c)/f,this._x=this._x*l+n*e,this._y=this._y*l+s*e,this._z=this._z*l+r*e,this._w=this._w*l+o*e,this._onChangeCallback()}else this._x=this._x*l+n*e,this._y=this._y*l+s*e,this._z=this._z*l+r*e,this._w=this._w*l+o*e,this.normalize();return this}slerpQuaternions(t,e,n){return this.copy(t).slerp(e,n)}random(){let t=2*Math.PI*Math.random(),e=2*Math.PI*Math.random(),n=Math.random(),s=Math.sqrt(1-n),r=Math.sqrt(n);return this.set(s*Math.sin(t),s*Math.cos(t),r*Math.sin(e),r*Math.cos(e))}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._w===this._w}fromArray(t,e=0){return this._x=t[e],this._y=t[e+1],this._z=t[e+2],this._w=t[e+3],this._onChangeCallback(),this}toArray(t=[],e=0){return t[e]=this._x,t[e+1]=this._y,t[e+2]=this._z,t[e+3]=this._w,t}fromBufferAttribute(t,e){return this._x=t.getX(e),this._y=t.getY(e),this._z=t.getZ(e),this._w=t.getW(e),this._onChangeCallback(),this}toJSON(){return this.toArray()}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._w}},Gd=class Gd{constructor(t=0,e=0,n=0){this.x=t,this.y=e,this.z=n}set(t,e,n){return n===void 0&&(n=this.z),this.x=t,this.y=e,this.z=n,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;case 2:this.z=e;break;default:throw new Error("THREE.Vector3: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;default:throw new Error("THREE.Vector3: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this.z=t.z+e.z,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this.z+=t.z*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this.z=t.z-e.z,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this}multiplyVectors(t,e){return this.x=t.x*e.x,this.y=t.y*e.y,this.z=t.z*e.z,this}applyEuler(t){return this.applyQuaternion(Xm.setFromEuler(t))}applyAxisAngle(t,e){return this.applyQuaternion(Xm.setFromAxisAngle(t,e))}applyMatrix3(t){let e=this.x,n=this.y,s=this.z,r=t.elements;return this.x=r[0]*e+r[3]*n+r[6]*s,this.y=r[1]*e+r[4]*n+r[7]*s,this.z=r[2]*e+r[5]*n+r[8]*s,this}applyNormalMatrix(t){return this.applyMatrix3(t).normalize()}applyMatrix4(t){let e=this.x,n=this.y,s=this.z,r=t.elements,o=1/(r[3]*e+r[7]*n+r[11]*s+r[15]);return this.x=(r[0]*e+r[4]*n+r[8]*s+r[12])*o,this.y=(r[1]*e+r[5]*n+r[9]*s+r[13])*o,this.z=(r[2]*e+r[6]*n+r[10]*s+r[14])*o,this}applyQuaternion(t){let e=this.x,n=this.y,s=this.z,r=t.x,o=t.y,a=t.z,l=t.w,c=2*(o*s-a*n),f=2*(a*e-r*s),u=2*(r*n-o*e);return this.x=e+l*c+o*u-a*f,this.y=n+l*f+a*c-r*u,this.z=s+l*u+r*f-o*c,this}project(t){return this.applyMatrix4(t.matrixWorldInverse).applyMatrix4(t.projectionMatrix)}unproject(t){return this.applyMatrix4(t.projectionMatrixInverse).applyMatrix4(t.matrixWorld)}transformDirection(t){let e=this.x,n=this.y,s=this.z,r=t.elements;return this.x=r[0]*e+r[4]*n+r[8]*s,this.y=r[1]*e+r[5]*n+r[9]*s,this.z=r[2]*e+r[6]*n+r[10]*s,this.normalize()}divide(t){return this.x/=t.x,this.y/=t.y,this.z/=t.z,this}divideScalar(t){return this.multiplyScalar(1/t)}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this}clamp(t,e){return this.x=ae(this.x,t.x,e.x),this.y=ae(this.y,t.y,e.y),this.z=ae(this.z,t.z,e.z),this}clampScalar(t,e){return this.x=ae(this.x,t,e),this.y=ae(this.y,t,e),this.z=ae(this.z,t,e),this}clampLength(t,e){let n=this.length();return this.divideScalar(n||1).multiplyScalar(ae(n,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this.z+=(t.z-this.z)*e,this}lerpVectors(t,e,n){return this.x=t.x+(e.x-t.x)*n,this.y=t.y+(e.y-t.y)*n,this.z=t.z+(e.z-t.z)*n,this}cross(t){return this.crossVectors(this,t)}crossVectors(t,e){let n=t.x,s=t.y,r=t.z,o=e.x,a=e.y,l=e.z;return this.x=s*l-r*a,this.y=r*o-n*l,this.z=n*a-s*o,this}projectOnVector(t){let e=t.lengthSq();if(e===0)return this.set(0,0,0);let n=t.dot(this)/e;return this.copy(t).multiplyScalar(n)}projectOnPlane(t){return Cf.copy(this).projectOnVector(t),this.sub(Cf)}reflect(t){return this.sub(Cf.copy(t).multiplyScalar(2*this.dot(t)))}angleTo(t){let e=Math.sqrt(this.lengthSq()*t.lengthSq());if(e===0)return Math.PI/2;let n=this.dot(t)/e;return Math.acos(ae(n,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){let e=this.x-t.x,n=this.y-t.y,s=this.z-t.z;return e*e+n*n+s*s}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)+Math.abs(this.z-t.z)}setFromSpherical(t){return this.setFromSphericalCoords(t.radius,t.phi,t.theta)}setFromSphericalCoords(t,e,n){let s=Math.sin(e)*t;return this.x=s*Math.sin(n),this.y=Math.cos(e)*t,this.z=s*Math.cos(n),this}setFromCylindrical(t){return this.setFromCylindricalCoords(t.radius,t.theta,t.y)}setFromCylindricalCoords(t,e,n){return this.x=t*Math.sin(e),this.y=n,this.z=t*Math.cos(e),this}setFromMatrixPosition(t){let e=t.elements;return this.x=e[12],this.y=e[13],this.z=e[14],this}setFromMatrixScale(t){let e=this.setFromMatrixColumn(t,0).length(),n=this.setFromMatrixColumn(t,1).length(),s=this.setFromMatrixColumn(t,2).length();return this.x=e,this.y=n,this.z=s,this}setFromMatrixColumn(t,e){return this.fromArray(t.elements,e*4)}setFromMatrix3Column(t,e){return this.fromArray(t.elements,e*3)}setFromEuler(t){return this.x=t._x,this.y=t._y,this.z=t._z,this}setFromColor(t){return this.x=t.r,this.y=t.g,this.z=t.b,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this.z=t[e+2],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t[e+2]=this.z,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this.z=t.getZ(e),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this}randomDirection(){let t=Math.random()*Math.PI*2,e=Math.random()*2-1,n=Math.sqrt(1-e*e);return this.x=n*Math.cos(t),this.y=e,this.z=n*Math.sin(t),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z}};Gd.prototype.isVector3=!0;var U=Gd,Cf=new U,Xm=new en,Hd=class Hd{constructor(t,e,n,s,r,o,a,l,c){this.elements=[1,0,0,0,1,0,0,0,1],t!==void 0&&this.set(t,e,n,s,r,o,a,l,c)}set(t,e,n,s,r,o,a,l,c){let f=this.elements;return f[0]=t,f[1]=s,f[2]=a,f[3]=e,f[4]=r,f[5]=l,f[6]=n,f[7]=o,f[8]=c,this}identity(){return this.set(1,0,0,0,1,0,0,0,1),this}copy(t){let e=this.elements,n=t.elements;return e[0]=n[0],e[1]=n[1],e[2]=n[2],e[3]=n[3],e[4]=n[4],e[5]=n[5],e[6]=n[6],e[7]=n[7],e[8]=n[8],this}extractBasis(t,e,n){return t.setFromMatrix3Column(this,0),e.setFromMatrix3Column(this,1),n.setFromMatrix3Column(this,2),this}setFromMatrix4(t){let e=t.elements;return this.set(e[0],e[4],e[8],e[1],e[5],e[9],e[2],e[6],e[10]),this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,e){let n=t.elements,s=e.elements,r=this.elements,o=n[0],a=n[3],l=n[6],c=n[1],f=n[4],u=n[7],h=n[2],d=n[5],g=n[8],v=s[0],m=s[3],p=s[6],_=s[1],M=s[4],y=s[7],w=s[2],T=s[5],x=s[8];return r[0]=o*v+a*_+l*w,r[3]=o*m+a*M+l*T,r[6]=o*p+a*y+l*x,r[1]=c*v+f*_+u*w,r[4]=c*m+f*M+u*T,r[7]=c*p+f*y+u*x,r[2]=h*v+d*_+g*w,r[5]=h*m+d*M+g*T,r[8]=h*p+d*y+g*x,this}multiplyScalar(t){let e=this.elements;return e[0]*=t,e[3]*=t,e[6]*=t,e[1]*=t,e[4]*=t,e[7]*=t,e[2]*=t,e[5]*=t,e[8]*=t,this}determinant(){let t=this.elements,e=t[0],n=t[1],s=t[2],r=t[3],o=t[4],a=t[5],l=t[6],c=t[7],f=t[8];return e*o*f-e*a*c-n*r*f+n*a*l+s*r*c-s*o*l}invert(){let t=this.elements,e=t[0],n=t[1],s=t[2],r=t[3],o=t[4],a=t[5],l=t[6],c=t[7],f=t[8],u=f*o-a*c,h=a*l-f*r,d=c*r-o*l,g=e*u+n*h+s*d;if(g===0)return this.set(0,0,0,0,0,0,0,0,0);let v=1/g;return t[0]=u*v,t[1]=(s*c-f*n)*v,t[2]=(a*n-s*o)*v,t[3]=h*v,t[4]=(f*e-s*l)*v,t[5]=(s*r-a*e)*v,t[6]=d*v,t[7]=(n*l-c*e)*v,t[8]=(o*e-n*r)*v,this}transpose(){let t,e=this.elements;return t=e[1],e[1]=e[3],e[3]=t,t=e[2],e[2]=e[6],e[6]=t,t=e[5],e[5]=e[7],e[7]=t,this}getNormalMatrix(t){return this.setFromMatrix4(t).invert().transpose()}transposeIntoArray(t){let e=this.elements;return t[0]=e[0],t[1]=e[3],t[2]=e[6],t[3]=e[1],t[4]=e[4],t[5]=e[7],t[6]=e[2],t[7]=e[5],t[8]=e[8],this}setUvTransform(t,e,n,s,r,o,a){let l=Math.cos(r),c=Math.sin(r);return this.set(n*l,n*c,-n*(l*o+c*a)+o+t,-s*c,s*l,-s*(-c*o+l*a)+a+e,0,0,1),this}scale(t,e){return Pa("Matrix3: .scale() is deprecated. Use .makeScale() instead."),this.premultiply(Rf.makeScale(t,e)),this}rotate(t){return Pa("Matrix3: .rotate() is deprecated. Use .makeRotation() instead."),this.premultiply(Rf.makeRotation(-t)),this}translate(t,e){return Pa("Matrix3: .translate() is deprecated. Use .makeTranslation() instead."),this.premultiply(Rf.makeTranslation(t,e)),this}makeTranslation(t,e){return t.isVector2?this.set(1,0,t.x,0,1,t.y,0,0,1):this.set(1,0,t,0,1,e,0,0,1),this}makeRotation(t){let e=Math.cos(t),n=Math.sin(t);return this.set(e,-n,0,n,e,0,0,0,1),this}makeScale(t,e){return this.set(t,0,0,0,e,0,0,0,1),this}equals(t){let e=this.elements,n=t.elements;for(let s=0;s<9;s++)if(e[s]!==n[s])return!1;return!0}fromArray(t,e=0){for(let n=0;n<9;n++)this.elements[n]=t[n+e];return this}toArray(t=[],e=0){let n=this.elements;return t[e]=n[0],t[e+1]=n[1],t[e+2]=n[2],t[e+3]=n[3],t[e+4]=n[4],t[e+5]=n[5],t[e+6]=n[6],t[e+7]=n[7],t[e+8]=n[8],t}clone(){return new this.constructor().fromArray(this.elements)}};Hd.prototype.isMatrix3=!0;var ie=Hd,Rf=new ie,qm=new ie().set(.4123908,.3575843,.1804808,.212639,.7151687,.0721923,.0193308,.1191948,.9505322),Ym=new ie().set(3.2409699,-1.5373832,-.4986108,-.9692436,1.8759675,.0415551,.0556301,-.203977,1.0569715);function gv(){let i={enabled:!0,workingColorSpace:Na,spaces:{},convert:function(s,r,o){return this.enabled===!1||r===o||!r||!o||(this.spaces[r].transfer===Re&&(s.r=Cs(s.r),s.g=Cs(s.g),s.b=Cs(s.b)),this.spaces[r].primaries!==this.spaces[o].primaries&&(s.applyMatrix3(this.spaces[r].toXYZ),s.applyMatrix3(this.spaces[o].fromXYZ)),this.spaces[o].transfer===Re&&(s.r=yo(s.r),s.g=yo(s.g),s.b=yo(s.b))),s},workingToColorSpace:function(s,r){return this.convert(s,this.workingColorSpace,r)},colorSpaceToWorking:function(s,r){return this.convert(s,r,this.workingColorSpace)},getPrimaries:function(s){return this.spaces[s].primaries},getTransfer:function(s){return s===Fs?Ua:this.spaces[s].transfer},getToneMappingMode:function(s){return this.spaces[s].outputColorSpaceConfig.toneMappingMode||"standard"},getLuminanceCoefficients:function(s,r=this.workingColorSpace){return s.fromArray(this.spaces[r].luminanceCoefficients)},define:function(s){Object.assign(this.spaces,s)},_getMatrix:function(s,r,o){return s.copy(this.spaces[o].fromXYZ).multiply(this.spaces[r].toXYZ)},_getDrawingBufferColorSpace:function(s){return this.spaces[s].outputColorSpaceConfig.drawingBufferColorSpace},_getUnpackColorSpace:function(s=this.workingColorSpace){return this.spaces[s].workingColorSpaceConfig.unpackColorSpace}},t=[.64,.33,.3,.6,.15,.06],e=[.2126,.7152,.0722],n=[.3127,.329];return i.define({[Na]:{primaries:t,whitePoint:n,transfer:Ua,toXYZ:qm,fromXYZ:Ym,luminanceCoefficients:e,workingColorSpaceConfig:{unpackColorSpace:yi},outputColorSpaceConfig:{drawingBufferColorSpace:yi}},[yi]:{primaries:t,whitePoint:n,transfer:Re,toXYZ:qm,fromXYZ:Ym,luminanceCoefficients:e,outputColorSpaceConfig:{drawingBufferColorSpace:yi}}}),i}var xe=gv();function Cs(i){return i<.04045?i*.0773993808:Math.pow(i*.9478672986+.0521327014,2.4)}function yo(i){return i<.0031308?i*12.92:1.055*Math.pow(i,.41666)-.055}var no,bc=class{static getDataURL(t,e="image/png"){if(/^data:/i.test(t.src)||typeof HTMLCanvasElement>"u")return t.src;let n;if(t instanceof HTMLCanvasElement)n=t;else{no===void 0&&(no=Fa("canvas")),no.width=t.width,no.height=t.height;let s=no.getContext("2d");t instanceof ImageData?s.putImageData(t,0,0):s.drawImage(t,0,0,t.width,t.height),n=no}return n.toDataURL(e)}static sRGBToLinear(t){if(typeof HTMLImageElement<"u"&&t instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&t instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&t instanceof ImageBitmap){let e=Fa("canvas");e.width=t.width,e.height=t.height;let n=e.getContext("2d");n.drawImage(t,0,0,t.width,t.height);let s=n.getImageData(0,0,t.width,t.height),r=s.data;for(let o=0;o<r.length;o++)r[o]=Cs(r[o]/255)*255;return n.putImageData(s,0,0),e}else if(t.data){let e=t.data.slice(0);for(let n=0;n<e.length;n++)e instanceof Uint8Array||e instanceof Uint8ClampedArray?e[n]=Math.floor(Cs(e[n]/255)*255):e[n]=Cs(e[n]);return{data:e,width:t.width,height:t.height}}else return Yt("ImageUtils.sRGBToLinear(): Unsupported image type. No color space conversion applied."),t}},_v=0,wo=class{constructor(t=null){this.isTextureSource=!0,Object.defineProperty(this,"id",{value:_v++}),this.uuid=Bo(),this.data=t,this.dataReady=!0,this.version=0}getSize(t){let e=this.data;return typeof HTMLVideoElement<"u"&&e instanceof HTMLVideoElement?t.set(e.videoWidth,e.videoHeight,0):typeof VideoFrame<"u"&&e instanceof VideoFrame?t.set(e.displayWidth,e.displayHeight,0):e!==null?t.set(e.width||0,e.height||0,e.depth||0):t.set(0,0,0),t}set needsUpdate(t){t===!0&&this.version++}toJSON(t){let e=t===void 0||typeof t=="string";if(!e&&t.images[this.uuid]!==void 0)return t.images[this.uuid];let n={uuid:this.uuid,url:""},s=this.data;if(s!==null){let r;if(Array.isArray(s)){r=[];for(let o=0,a=s.length;o<a;o++)s[o].isDataTexture?r.push(Pf(s[o].image)):r.push(Pf(s[o]))}else r=Pf(s);n.url=r}return e||(t.images[this.uuid]=n),n}};function Pf(i){return typeof HTMLImageElement<"u"&&i instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&i instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&i instanceof ImageBitmap?bc.getDataURL(i):i.data?{data:Array.from(i.data),width:i.width,height:i.height,type:i.data.constructor.name}:(Yt("Texture: Unable to serialize Texture."),{})}var xv=0,If=new U,ci=class i extends Vi{constructor(t=i.DEFAULT_IMAGE,e=i.DEFAULT_MAPPING,n=rs,s=rs,r=si,o=Ns,a=Xi,l=hi,c=i.DEFAULT_ANISOTROPY,f=Fs){super(),this.isTexture=!0,Object.defineProperty(this,"id",{value:xv++}),this.uuid=Bo(),this.name="",this.source=new wo(t),this.mipmaps=[],this.mapping=e,this.channel=0,this.wrapS=n,this.wrapT=s,this.magFilter=r,this.minFilter=o,this.anisotropy=c,this.format=a,this.internalFormat=null,this.type=l,this.offset=new kt(0,0),this.repeat=new kt(1,1),this.center=new kt(0,0),this.rotation=0,this.matrixAutoUpdate=!0,this.matrix=new ie,this.generateMipmaps=!0,this.mipmapsAutoUpdate=!0,this.premultiplyAlpha=!1,this.flipY=!0,this.unpackAlignment=4,this.colorSpace=f,this.userData={},this.updateRanges=[],this.version=0,this.onUpdate=null,this.renderTarget=null,this.isRenderTargetTexture=!1,this.isArrayTexture=!!(t&&t.depth&&t.depth>1),this.pmremVersion=0,this.isPMREMTexture=!1,this.normalized=!1}get width(){return this.source.getSize(If).x}get height(){return this.source.getSize(If).y}get depth(){return this.source.getSize(If).z}get image(){return this.source.data}set image(t){this.source.data=t}updateMatrix(){this.matrix.setUvTransform(this.offset.x,this.offset.y,this.repeat.x,this.repeat.y,this.rotation,this.center.x,this.center.y)}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}clone(){return new this.constructor().copy(this)}copy(t){return this.name=t.name,this.source=t.source,this.mipmaps=t.mipmaps.slice(0),this.mapping=t.mapping,this.channel=t.channel,this.wrapS=t.wrapS,this.wrapT=t.wrapT,this.magFilter=t.magFilter,this.minFilter=t.minFilter,this.anisotropy=t.anisotropy,this.format=t.format,this.internalFormat=t.internalFormat,this.type=t.type,this.normalized=t.normalized,this.offset.copy(t.offset),this.repeat.copy(t.repeat),this.center.copy(t.center),this.rotation=t.rotation,this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrix.copy(t.matrix),this.generateMipmaps=t.generateMipmaps,this.mipmapsAutoUpdate=t.mipmapsAutoUpdate,this.premultiplyAlpha=t.premultiplyAlpha,this.flipY=t.flipY,this.unpackAlignment=t.unpackAlignment,this.colorSpace=t.colorSpace,this.renderTarget=t.renderTarget,this.isRenderTargetTexture=t.isRenderTargetTexture,this.isPMREMTexture=t.isPMREMTexture,this.isArrayTexture=t.isArrayTexture,this.userData=JSON.parse(JSON.stringify(t.userData)),this.needsUpdate=!0,this}setValues(t){for(let e in t){let n=t[e];if(n===void 0){Yt(`Texture.setValues(): parameter '${e}' has value of undefined.`);continue}let s=this[e];if(s===void 0){Yt(`Texture.setValues(): property '${e}' does not exist.`);continue}s&&n&&s.isVector2&&n.isVector2||s&&n&&s.isVector3&&n.isVector3||s&&n&&s.isMatrix3&&n.isMatrix3?s.copy(n):this[e]=n}}toJSON(t){let e=t===void 0||typeof t=="string";if(!e&&t.textures[this.uuid]!==void 0)return t.textures[this.uuid];let n={metadata:{version:4.7,type:"Texture",generator:"Texture.toJSON"},uuid:this.uuid,name:this.name,image:this.source.toJSON(t).uuid,mapping:this.mapping,channel:this.channel,repeat:[this.repeat.x,this.repeat.y],offset:[this.offset.x,this.offset.y],center:[this.center.x,this.center.y],rotation:this.rotation,wrap:[this.wrapS,this.wrapT],format:this.format,internalFormat:this.internalFormat,type:this.type,normalized:this.normalized,colorSpace:this.colorSpace,minFilter:this.minFilter,magFilter:this.magFilter,anisotropy:this.anisotropy,flipY:this.flipY,generateMipmaps:this.generateMipmaps,mipmapsAutoUpdate:this.mipmapsAutoUpdate,premultiplyAlpha:this.premultiplyAlpha,unpackAlignment:this.unpackAlignment};return Object.keys(this.userData).length>0&&(n.userData=this.userData),e||(t.textures[this.uuid]=n),n}dispose(){this.dispatchEvent({type:"dispose"})}transformUv(t){if(this.mapping!==xd)return t;if(t.applyMatrix3(this.matrix),t.x<0||t.x>1)switch(this.wrapS){case vc:t.x=t.x-Math.floor(t.x);break;case rs:t.x=t.x<0?0:1;break;case Sc:Math.abs(Math.floor(t.x)%2)===1?t.x=Math.ceil(t.x)-t.x:t.x=t.x-Math.floor(t.x);break}if(t.y<0||t.y>1)switch(this.wrapT){case vc:t.y=t.y-Math.floor(t.y);break;case rs:t.y=t.y<0?0:1;break;case Sc:Math.abs(Math.floor(t.y)%2)===1?t.y=Math.ceil(t.y)-t.y:t.y=t.y-Math.floor(t.y);break}return this.flipY&&(t.y=1-t.y),t}set needsUpdate(t){t===!0&&(this.version++,this.source.needsUpdate=!0)}set needsPMREMUpdate(t){t===!0&&this.pmremVersion++}};ci.DEFAULT_IMAGE=null;ci.DEFAULT_MAPPING=xd;ci.DEFAULT_ANISOTROPY=1;var Wd=class Wd{constructor(t=0,e=0,n=0,s=1){this.x=t,this.y=e,this.z=n,this.w=s}get width(){return this.z}set width(t){this.z=t}get height(){return this.w}set height(t){this.w=t}set(t,e,n,s){return this.x=t,this.y=e,this.z=n,this.w=s,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this.w=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setW(t){return this.w=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;case 2:this.z=e;break;case 3:this.w=e;break;default:throw new Error("THREE.Vector4: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;case 3:return this.w;default:throw new Error("THREE.Vector4: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z,this.w)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this.w=t.w!==void 0?t.w:1,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this.w+=t.w,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this.w+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this.z=t.z+e.z,this.w=t.w+e.w,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this.z+=t.z*e,this.w+=t.w*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this.w-=t.w,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this.w-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this.z=t.z-e.z,this.w=t.w-e.w,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this.w*=t.w,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this.w*=t,this}applyMatrix4(t){let e=this.x,n=this.y,s=this.z,r=this.w,o=t.elements;return this.x=o[0]*e+o[4]*n+o[8]*s+o[12]*r,this.y=o[1]*e+o[5]*n+o[9]*s+o[13]*r,this.z=o[2]*e+o[6]*n+o[10]*s+o[14]*r,this.w=o[3]*e+o[7]*n+o[11]*s+o[15]*r,this}divide(t){return this.x/=t.x,this.y/=t.y,this.z/=t.z,this.w/=t.w,this}divideScalar(t){return this.multiplyScalar(1/t)}setAxisAngleFromQuaternion(t){this.w=2*Math.acos(t.w);let e=Math.sqrt(1-t.w*t.w);return e<1e-4?(this.x=1,this.y=0,this.z=0):(this.x=t.x/e,this.y=t.y/e,this.z=t.z/e),this}setAxisAngleFromRotationMatrix(t){let e,n,s,r,l=t.elements,c=l[0],f=l[4],u=l[8],h=l[1],d=l[5],g=l[9],v=l[2],m=l[6],p=l[10];if(Math.abs(f-h)<.01&&Math.abs(u-v)<.01&&Math.abs(g-m)<.01){if(Math.abs(f+h)<.1&&Math.abs(u+v)<.1&&Math.abs(g+m)<.1&&Math.abs(c+d+p-3)<.1)return this.set(1,0,0,0),this;e=Math.PI;let M=(c+1)/2,y=(d+1)/2,w=(p+1)/2,T=(f+h)/4,x=(u+v)/4,b=(g+m)/4;return M>y&&M>w?M<.01?(n=0,s=.707106781,r=.707106781):(n=Math.sqrt(M),s=T/n,r=x/n):y>w?y<.01?(n=.707106781,s=0,r=.707106781):(s=Math.sqrt(y),n=T/s,r=b/s):w<.01?(n=.707106781,s=.707106781,r=0):(r=Math.sqrt(w),n=x/r,s=b/r),this.set(n,s,r,e),this}let _=Math.sqrt((m-g)*(m-g)+(u-v)*(u-v)+(h-f)*(h-f));return Math.abs(_)<.001&&(_=1),this.x=(m-g)/_,this.y=(u-v)/_,this.z=(h-f)/_,this.w=Math.acos((c+d+p-1)/2),this}setFromMatrixPosition(t){let e=t.elements;return this.x=e[12],this.y=e[13],this.z=e[14],this.w=e[15],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this.w=Math.min(this.w,t.w),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this.w=Math.max(this.w,t.w),this}clamp(t,e){return this.x=ae(this.x,t.x,e.x),this.y=ae(this.y,t.y,e.y),this.z=ae(this.z,t.z,e.z),this.w=ae(this.w,t.w,e.w),this}clampScalar(t,e){return this.x=ae(this.x,t,e),this.y=ae(this.y,t,e),this.z=ae(this.z,t,e),this.w=ae(this.w,t,e),this}clampLength(t,e){let n=this.length();return this.divideScalar(n||1).multiplyScalar(ae(n,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this.w=Math.floor(this.w),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this.w=Math.ceil(this.w),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this.w=Math.round(this.w),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this.w=Math.trunc(this.w),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this.w=-this.w,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z+this.w*t.w}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)+Math.abs(this.w)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this.z+=(t.z-this.z)*e,this.w+=(t.w-this.w)*e,this}lerpVectors(t,e,n){return this.x=t.x+(e.x-t.x)*n,this.y=t.y+(e.y-t.y)*n,this.z=t.z+(e.z-t.z)*n,this.w=t.w+(e.w-t.w)*n,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z&&t.w===this.w}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this.z=t[e+2],this.w=t[e+3],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t[e+2]=this.z,t[e+3]=this.w,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this.z=t.getZ(e),this.w=t.getW(e),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this.w=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z,yield this.w}};Wd.prototype.isVector4=!0;var nn=Wd,wc=class extends Vi{constructor(t=1,e=1,n={}){super(),n=Object.assign({generateMipmaps:!1,internalFormat:null,minFilter:si,depthBuffer:!0,stencilBuffer:!1,resolveColorBuffer:!0,resolveDepthBuffer:!0,resolveStencilBuffer:!0,storeMultisampledColorBuffer:!0,storeMultisampledDepthBuffer:!0,storeMultisampledStencilBuffer:!0,depthTexture:null,samples:0,count:1,depth:1,multiview:!1,useArrayDepthTexture:!1},n),this.isRenderTarget=!0,this.width=t,this.height=e,this.depth=n.depth,this.scissor=new nn(0,0,t,e),this.scissorTest=!1,this.viewport=new nn(0,0,t,e),this.textures=[];let s=n.count;for(let r=0;r<s;r++)this.textures[r]=new ci({width:t,height:e,depth:n.depth}),this.textures[r].isRenderTargetTexture=!0,this.textures[r].renderTarget=this;this._setTextureOptions(n),this.depthBuffer=n.depthBuffer,this.stencilBuffer=n.stencilBuffer,this.resolveColorBuffer=n.resolveColorBuffer,this.resolveDepthBuffer=n.resolveDepthBuffer,this.resolveStencilBuffer=n.resolveStencilBuffer,this.storeMultisampledColorBuffer=n.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=n.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=n.storeMultisampledStencilBuffer,this._depthTexture=null,this.depthTexture=n.depthTexture,this.samples=n.samples,this.multiview=n.multiview,this.useArrayDepthTexture=n.useArrayDepthTexture}_setTextureOptions(t={}){let e={minFilter:si,generateMipmaps:!1,flipY:!1,internalFormat:null};t.mapping!==void 0&&(e.mapping=t.mapping),t.wrapS!==void 0&&(e.wrapS=t.wrapS),t.wrapT!==void 0&&(e.wrapT=t.wrapT),t.wrapR!==void 0&&(e.wrapR=t.wrapR),t.magFilter!==void 0&&(e.magFilter=t.magFilter),t.minFilter!==void 0&&(e.minFilter=t.minFilter),t.format!==void 0&&(e.format=t.format),t.type!==void 0&&(e.type=t.type),t.anisotropy!==void 0&&(e.anisotropy=t.anisotropy),t.colorSpace!==void 0&&(e.colorSpace=t.colorSpace),t.flipY!==void 0&&(e.flipY=t.flipY),t.generateMipmaps!==void 0&&(e.generateMipmaps=t.generateMipmaps),t.mipmapsAutoUpdate!==void 0&&(e.mipmapsAutoUpdate=t.mipmapsAutoUpdate),t.internalFormat!==void 0&&(e.internalFormat=t.internalFormat);for(let n=0;n<this.textures.length;n++)this.textures[n].setValues(e)}get texture(){return this.textures[0]}set texture(t){this.textures[0]=t}set depthTexture(t){this._depthTexture!==null&&this._depthTexture.renderTarget===this&&(this._depthTexture.renderTarget=null),t!==null&&t.renderTarget===null&&(t.renderTarget=this),this._depthTexture=t}get depthTexture(){return this._depthTexture}setSize(t,e,n=1){if(this.width!==t||this.height!==e||this.depth!==n){this.width=t,this.height=e,this.depth=n;for(let s=0,r=this.textures.length;s<r;s++)this.textures[s].image.width=t,this.textures[s].image.height=e,this.textures[s].image.depth=n,this.textures[s].isData3DTexture!==!0&&(this.textures[s].isArrayTexture=this.textures[s].image.depth>1);this.dispose()}this.viewport.set(0,0,t,e),this.scissor.set(0,0,t,e)}clone(){return new this.constructor().copy(this)}copy(t){this.width=t.width,this.height=t.height,this.depth=t.depth,this.scissor.copy(t.scissor),this.scissorTest=t.scissorTest,this.viewport.copy(t.viewport),this.textures.length=0;for(let e=0,n=t.textures.length;e<n;e++){this.textures[e]=t.textures[e].clone(),this.textures[e].isRenderTargetTexture=!0,this.textures[e].renderTarget=this;let s=Object.assign({},t.textures[e].image);this.textures[e].source=new wo(s)}if(this.depthBuffer=t.depthBuffer,this.stencilBuffer=t.stencilBuffer,this.resolveColorBuffer=t.resolveColorBuffer,this.resolveDepthBuffer=t.resolveDepthBuffer,this.resolveStencilBuffer=t.resolveStencilBuffer,this.storeMultisampledColorBuffer=t.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=t.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=t.storeMultisampledStencilBuffer,t.depthTexture!==null)if(t.depthTexture.renderTarget===t){let e=t.depthTexture.clone();e.renderTarget=null,this.depthTexture=e}else this.depthTexture=t.depthTexture;else this.depthTexture=null;return this.samples=t.samples,this.multiview=t.multiview,this.useArrayDepthTexture=t.useArrayDepthTexture,this}dispose(){this.dispatchEvent({type:"dispose"})}},vi=class extends wc{constructor(t=1,e=1,n={}){super(t,e,n),this.isWebGLRenderTarget=!0}},Oa=class extends ci{constructor(t=null,e=1,n=1,s=1){super(null),this.isDataArrayTexture=!0,this.image={data:t,width:e,height:n,depth:s},this.magFilter=Vn,this.minFilter=Vn,this.wrapR=rs,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1,this.layerUpdates=new Set}copy(t){return super.copy(t),this.wrapR=t.wrapR,this}addLayerUpdate(t){this.layerUpdates.add(t)}clearLayerUpdates(){this.layerUpdates.clear()}};var Tc=class extends ci{constructor(t=null,e=1,n=1,s=1){super(null),this.isData3DTexture=!0,this.image={data:t,width:e,height:n,depth:s},this.magFilter=Vn,this.minFilter=Vn,this.wrapR=rs,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}copy(t){return super.copy(t),this.wrapR=t.wrapR,this}};var Wc=class Wc{constructor(t,e,n,s,r,o,a,l,c,f,u,h,d,g,v,m){this.elements=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],t!==void 0&&this.set(t,e,n,s,r,o,a,l,c,f,u,h,d,g,v,m)}set(t,e,n,s,r,o,a,l,c,f,u,h,d,g,v,m){let p=this.elements;return p[0]=t,p[4]=e,p[8]=n,p[12]=s,p[1]=r,p[5]=o,p[9]=a,p[13]=l,p[2]=c,p[6]=f,p[10]=u,p[14]=h,p[3]=d,p[7]=g,p[11]=v,p[15]=m,this}identity(){return this.set(1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1),this}clone(){return new Wc().fromArray(this.elements)}copy(t){let e=this.elements,n=t.elements;return e[0]=n[0],e[1]=n[1],e[2]=n[2],e[3]=n[3],e[4]=n[4],e[5]=n[5],e[6]=n[6],e[7]=n[7],e[8]=n[8],e[9]=n[9],e[10]=n[10],e[11]=n[11],e[12]=n[12],e[13]=n[13],e[14]=n[14],e[15]=n[15],this}copyPosition(t){let e=this.elements,n=t.elements;return e[12]=n[12],e[13]=n[13],e[14]=n[14],this}setFromMatrix3(t){let e=t.elements;return this.set(e[0],e[3],e[6],0,e[1],e[4],e[7],0,e[2],e[5],e[8],0,0,0,0,1),this}extractBasis(t,e,n){return this.determinantAffine()===0?(t.set(1,0,0),e.set(0,1,0),n.set(0,0,1),this):(t.setFromMatrixColumn(this,0),e.setFromMatrixColumn(this,1),n.setFromMatrixColumn(this,2),this)}makeBasis(t,e,n){return this.set(t.x,e.x,n.x,0,t.y,e.y,n.y,0,t.z,e.z,n.z,0,0,0,0,1),this}extractRotation(t){if(t.determinantAffine()===0)return this.identity();let e=this.elements,n=t.elements,s=1/io.setFromMatrixColumn(t,0).length(),r=1/io.setFromMatrixColumn(t,1).length(),o=1/io.setFromMatrixColumn(t,2).length();return e[0]=n[0]*s,e[1]=n[1]*s,e[2]=n[2]*s,e[3]=0,e[4]=n[4]*r,e[5]=n[5]*r,e[6]=n[6]*r,e[7]=0,e[8]=n[8]*o,e[9]=n[9]*o,e[10]=n[10]*o,e[11]=0,e[12]=0,e[13]=0,e[14]=0,e[15]=1,this}makeRotationFromEuler(t){let e=this.elements,n=t.x,s=t.y,r=t.z,o=Math.cos(n),a=Math.sin(n),l=Math.cos(s),c=Math.sin(s),f=Math.cos(r),u=Math.sin(r);if(t.order==="XYZ"){let h=o*f,d=o*u,g=a*f,v=a*u;e[0]=l*f,e[4]=-l*u,e[8]=c,e[1]=d+g*c,e[5]=h-v*c,e[9]=-a*l,e[2]=v-h*c,e[6]=g+d*c,e[10]=o*l}else if(t.order==="YXZ"){let h=l*f,d=l*u,g=c*f,v=c*u;e[0]=h+v*a,e[4]=g*a-d,e[8]=o*c,e[1]=o*u,e[5]=o*f,e[9]=-a,e[2]=d*a-g,e[6]=v+h*a,e[10]=o*l}else if(t.order==="ZXY"){let h=l*f,d=l*u,g=c*f,v=c*u;e[0]=h-v*a,e[4]=-o*u,e[8]=g+d*a,e[1]=d+g*a,e[5]=o*f,e[9]=v-h*a,e[2]=-o*c,e[6]=a,e[10]=o*l}else if(t.order==="ZYX"){let h=o*f,d=o*u,g=a*f,v=a*u;e[0]=l*f,e[4]=g*c-d,e[8]=h*c+v,e[1]=l*u,e[5]=v*c+h,e[9]=d*c-g,e[2]=-c,e[6]=a*l,e[10]=o*l}else if(t.order==="YZX"){let h=o*l,d=o*c,g=a*l,v=a*c;e[0]=l*f,e[4]=v-h*u,e[8]=g*u+d,e[1]=u,e[5]=o*f,e[9]=-a*f,e[2]=-c*f,e[6]=d*u+g,e[10]=h-v*u}else if(t.order==="XZY"){let h=o*l,d=o*c,g=a*l,v=a*c;e[0]=l*f,e[4]=-u,e[8]=c*f,e[1]=h*u+v,e[5]=o*f,e[9]=d*u-g,e[2]=g*u-d,e[6]=a*f,e[10]=v*u+h}return e[3]=0,e[7]=0,e[11]=0,e[12]=0,e[13]=0,e[14]=0,e[15]=1,this}makeRotationFromQuaternion(t){return this.compose(yv,t,vv)}lookAt(t,e,n){let s=this.elements;return _i.subVectors(t,e),_i.lengthSq()===0&&(_i.z=1),_i.normalize(),qs.crossVectors(n,_i),qs.lengthSq()===0&&(Math.abs(n.z)===1?_i.x+=1e-4:_i.z+=1e-4,_i.normalize(),qs.crossVectors(n,_i)),qs.normalize(),Gl.crossVectors(_i,qs),s[0]=qs.x,s[4]=Gl.x,s[8]=_i.x,s[1]=qs.y,s[5]=Gl.y,s[9]=_i.y,s[2]=qs.z,s[6]=Gl.z,s[10]=_i.z,this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,e){let n=t.elements,s=e.elements,r=this.elements,o=n[0],a=n[4],l=n[8],c=n[12],f=n[1],u=n[5],h=n[9],d=n[13],g=n[2],v=n[6],m=n[10],p=n[14],_=n[3],M=n[7],y=n[11],w=n[15],T=s[0],x=s[4],b=s[8],D=s[12],C=s[1],P=s[5],I=s[9],O=s[13],L=s[2],z=s[6],X=s[10],H=s[14],at=s[3],Z=s[7],j=s[11],nt=s[15];return r[0]=o*T+a*C+l*L+c*at,r[4]=o*x+a*P+l*z+c*Z,r[8]=o*b+a*I+l*X+c*j,r[12]=o*D+a*O+l*H+c*nt,r[1]=f*T+u*C+h*L+d*at,r[5]=f*x+u*P+h*z+d*Z,r[9]=f*b+u*I+h*X+d*j,r[13]=f*D+u*O+h*H+d*nt,r[2]=g*T+v*C+m*L+p*at,r[6]=g*x+v*P+m*z+p*Z,r[10]=g*b+v*I+m*X+p*j,r[14]=g*D+v*O+m*H+p*nt,r[3]=_*T+M*C+y*L+w*at,r[7]=_*x+M*P+y*z+w*Z,r[11]=_*b+M*I+y*X+w*j,r[15]=_*D+M*O+y*H+w*nt,this}multiplyScalar(t){let e=this.elements;return e[0]*=t,e[4]*=t,e[8]*=t,e[12]*=t,e[1]*=t,e[5]*=t,e[9]*=t,e[13]*=t,e[2]*=t,e[6]*=t,e[10]*=t,e[14]*=t,e[3]*=t,e[7]*=t,e[11]*=t,e[15]*=t,this}determinant(){let t=this.elements,e=t[0],n=t[4],s=t[8],r=t[12],o=t[1],a=t[5],l=t[9],c=t[13],f=t[2],u=t[6],h=t[10],d=t[14],g=t[3],v=t[7],m=t[11],p=t[15],_=l*d-c*h,M=a*d-c*u,y=a*h-l*u,w=o*d-c*f,T=o*h-l*f,x=o*u-a*f;return e*(v*_-m*M+p*y)-n*(g*_-m*w+p*T)+s*(g*M-v*w+p*x)-r*(g*y-v*T+m*x)}determinantAffine(){let t=this.elements,e=t[0],n=t[4],s=t[8],r=t[1],o=t[5],a=t[9],l=t[2],c=t[6],f=t[10];return e*(o*f-a*c)-n*(r*f-a*l)+s*(r*c-o*l)}transpose(){let t=this.elements,e;return e=t[1],t[1]=t[4],t[4]=e,e=t[2],t[2]=t[8],t[8]=e,e=t[6],t[6]=t[9],t[9]=e,e=t[3],t[3]=t[12],t[12]=e,e=t[7],t[7]=t[13],t[13]=e,e=t[11],t[11]=t[14],t[14]=e,this}setPosition(t,e,n){let s=this.elements;return t.isVector3?(s[12]=t.x,s[13]=t.y,s[14]=t.z):(s[12]=t,s[13]=e,s[14]=n),this}invert(){let t=this.elements,e=t[0],n=t[1],s=t[2],r=t[3],o=t[4],a=t[5],l=t[6],c=t[7],f=t[8],u=t[9],h=t[10],d=t[11],g=t[12],v=t[13],m=t[14],p=t[15],_=e*a-n*o,M=e*l-s*o,y=e*c-r*o,w=n*l-s*a,T=n*c-r*a,x=s*c-r*l,b=f*v-u*g,D=f*m-h*g,C=f*p-d*g,P=u*m-h*v,I=u*p-d*v,O=h*p-d*m,L=_*O-M*I+y*P+w*C-T*D+x*b;if(L===0)return this.set(0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0);let z=1/L;return t[0]=(a*O-l*I+c*P)*z,t[1]=(s*I-n*O-r*P)*z,t[2]=(v*x-m*T+p*w)*z,t[3]=(h*T-u*x-d*w)*z,t[4]=(l*C-o*O-c*D)*z,t[5]=(e*O-s*C+r*D)*z,t[6]=(m*y-g*x-p*M)*z,t[7]=(f*x-h*y+d*M)*z,t[8]=(o*I-a*C+c*b)*z,t[9]=(n*C-e*I-r*b)*z,t[10]=(g*T-v*y+p*_)*z,t[11]=(u*y-f*T-d*_)*z,t[12]=(a*D-o*P-l*b)*z,t[13]=(e*P-n*D+s*b)*z,t[14]=(v*M-g*w-m*_)*z,t[15]=(f*w-u*M+h*_)*z,this}scale(t){let e=this.elements,n=t.x,s=t.y,r=t.z;return e[0]*=n,e[4]*=s,e[8]*=r,e[1]*=n,e[5]*=s,e[9]*=r,e[2]*=n,e[6]*=s,e[10]*=r,e[3]*=n,e[7]*=s,e[11]*=r,this}getMaxScaleOnAxis(){let t=this.elements,e=t[0]*t[0]+t[1]*t[1]+t[2]*t[2],n=t[4]*t[4]+t[5]*t[5]+t[6]*t[6],s=t[8]*t[8]+t[9]*t[9]+t[10]*t[10];return Math.sqrt(Math.max(e,n,s))}makeTranslation(t,e,n){return t.isVector3?this.set(1,0,0,t.x,0,1,0,t.y,0,0,1,t.z,0,0,0,1):this.set(1,0,0,t,0,1,0,e,0,0,1,n,0,0,0,1),this}makeRotationX(t){let e=Math.cos(t),n=Math.sin(t);return this.set(1,0,0,0,0,e,-n,0,0,n,e,0,0,0,0,1),this}makeRotationY(t){let e=Math.cos(t),n=Math.sin(t);return this.set(e,0,n,0,0,1,0,0,-n,0,e,0,0,0,0,1),this}makeRotationZ(t){let e=Math.cos(t),n=Math.sin(t);return this.set(e,-n,0,0,n,e,0,0,0,0,1,0,0,0,0,1),this}makeRotationAxis(t,e){let n=Math.cos(e),s=Math.sin(e),r=1-n,o=t.x,a=t.y,l=t.z,c=r*o,f=r*a;return this.set(c*o+n,c*a-s*l,c*l+s*a,0,c*a+s*l,f*a+n,f*l-s*o,0,c*l-s*a,f*l+s*o,r*l*l+n,0,0,0,0,1),this}makeScale(t,e,n){return this.set(t,0,0,0,0,e,0,0,0,0,n,0,0,0,0,1),this}makeShear(t,e,n,s,r,o){return this.set(1,n,r,0,t,1,o,0,e,s,1,0,0,0,0,1),this}compose(t,e,n){let s=this.elements,r=e._x,o=e._y,a=e._z,l=e._w,c=r+r,f=o+o,u=a+a,h=r*c,d=r*f,g=r*u,v=o*f,m=o*u,p=a*u,_=l*c,M=l*f,y=l*u,w=n.x,T=n.y,x=n.z;return s[0]=(1-(v+p))*w,s[1]=(d+y)*w,s[2]=(g-M)*w,s[3]=0,s[4]=(d-y)*T,s[5]=(1-(h+p))*T,s[6]=(m+_)*T,s[7]=0,s[8]=(g+M)*x,s[9]=(m-_)*x,s[10]=(1-(h+v))*x,s[11]=0,s[12]=t.x,s[13]=t.y,s[14]=t.z,s[15]=1,this}decompose(t,e,n){let s=this.elements;t.x=s[12],t.y=s[13],t.z=s[14];let r=this.determinantAffine();if(r===0)return n.set(1,1,1),e.identity(),this;let o=io.set(s[0],s[1],s[2]).length(),a=io.set(s[4],s[5],s[6]).length(),l=io.set(s[8],s[9],s[10]).length();r<0&&(o=-o),Bi.copy(this);let c=1/o,f=1/a,u=1/l;return Bi.elements[0]*=c,Bi.elements[1]*=c,Bi.elements[2]*=c,Bi.elements[4]*=f,Bi.elements[5]*=f,Bi.elements[6]*=f,Bi.elements[8]*=u,Bi.elements[9]*=u,Bi.elements[10]*=u,e.setFromRotationMatrix(Bi),n.x=o,n.y=a,n.z=l,this}makePerspective(t,e,n,s,r,o,a=Ii,l=!1){let c=this.elements,f=2*r/(e-t),u=2*r/(n-s),h=(e+t)/(e-t),d=(n+s)/(n-s),g,v;if(l)g=r/(o-r),v=o*r/(o-r);else if(a===Ii)g=-(o+r)/(o-r),v=-2*o*r/(o-r);else if(a===So)g=-o/(o-r),v=-o*r/(o-r);else throw new Error("THREE.Matrix4.makePerspective(): Invalid coordinate system: "+a);return c[0]=f,c[4]=0,c[8]=h,c[12]=0,c[1]=0,c[5]=u,c[9]=d,c[13]=0,c[2]=0,c[6]=0,c[10]=g,c[14]=v,c[3]=0,c[7]=0,c[11]=-1,c[15]=0,this}makeOrthographic(t,e,n,s,r,o,a=Ii,l=!1){let c=this.elements,f=2/(e-t),u=2/(n-s),h=-(e+t)/(e-t),d=-(n+s)/(n-s),g,v;if(l)g=1/(o-r),v=o/(o-r);else if(a===Ii)g=-2/(o-r),v=-(o+r)/(o-r);else if(a===So)g=-1/(o-r),v=-r/(o-r);else throw new Error("THREE.Matrix4.makeOrthographic(): Invalid coordinate system: "+a);return c[0]=f,c[4]=0,c[8]=0,c[12]=h,c[1]=0,c[5]=u,c[9]=0,c[13]=d,c[2]=0,c[6]=0,c[10]=g,c[14]=v,c[3]=0,c[7]=0,c[11]=0,c[15]=1,this}equals(t){let e=this.elements,n=t.elements;for(let s=0;s<16;s++)if(e[s]!==n[s])return!1;return!0}fromArray(t,e=0){for(let n=0;n<16;n++)this.elements[n]=t[n+e];return this}toArray(t=[],e=0){let n=this.elements;return t[e]=n[0],t[e+1]=n[1],t[e+2]=n[2],t[e+3]=n[3],t[e+4]=n[4],t[e+5]=n[5],t[e+6]=n[6],t[e+7]=n[7],t[e+8]=n[8],t[e+9]=n[9],t[e+10]=n[10],t[e+11]=n[11],t[e+12]=n[12],t[e+13]=n[13],t[e+14]=n[14],t[e+15]=n[15],t}};Wc.prototype.isMatrix4=!0;var te=Wc,io=new U,Bi=new te,yv=new U(0,0,0),vv=new U(1,1,1),qs=new U,Gl=new U,_i=new U,Zm=new te,$m=new en,Ps=class i{constructor(t=0,e=0,n=0,s=i.DEFAULT_ORDER){this.isEuler=!0,this._x=t,this._y=e,this._z=n,this._order=s}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get order(){return this._order}set order(t){this._order=t,this._onChangeCallback()}set(t,e,n,s=this._order){return this._x=t,this._y=e,this._z=n,this._order=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._order)}copy(t){return this._x=t._x,this._y=t._y,this._z=t._z,this._order=t._order,this._onChangeCallback(),this}setFromRotationMatrix(t,e=this._order,n=!0){let s=t.elements,r=s[0],o=s[4],a=s[8],l=s[1],c=s[5],f=s[9],u=s[2],h=s[6],d=s[10];switch(e){case"XYZ":this._y=Math.asin(ae(a,-1,1)),Math.abs(a)<.9999999?(this._x=Math.atan2(-f,d),this._z=Math.atan2(-o,r)):(this._x=Math.atan2(h,c),this._z=0);break;case"YXZ":this._x=Math.asin(-ae(f,-1,1)),Math.abs(f)<.9999999?(this._y=Math.atan2(a,d),this._z=Math.atan2(l,c)):(this._y=Math.atan2(-u,r),this._z=0);break;case"ZXY":this._x=Math.asin(ae(h,-1,1)),Math.abs(h)<.9999999?(this._y=Math.atan2(-u,d),this._z=Math.atan2(-o,c)):(this._y=0,this._z=Math.atan2(l,r));break;case"ZYX":this._y=Math.asin(-ae(u,-1,1)),Math.abs(u)<.9999999?(this._x=Math.atan2(h,d),this._z=Math.atan2(l,r)):(this._x=0,this._z=Math.atan2(-o,c));break;case"YZX":this._z=Math.asin(ae(l,-1,1)),Math.abs(l)<.9999999?(this._x=Math.atan2(-f,c),this._y=Math.atan2(-u,r)):(this._x=0,this._y=Math.atan2(a,d));break;case"XZY":this._z=Math.asin(-ae(o,-1,1)),Math.abs(o)<.9999999?(this._x=Math.atan2(h,c),this._y=Math.atan2(a,r)):(this._x=Math.atan2(-f,d),this._y=0);break;default:Yt("Euler: .setFromRotationMatrix() encountered an unknown order: "+e)}return this._order=e,n===!0&&this._onChangeCallback(),this}setFromQuaternion(t,e,n){return Zm.makeRotationFromQuaternion(t),this.setFromRotationMatrix(Zm,e,n)}setFromVector3(t,e=this._order){return this.set(t.x,t.y,t.z,e)}reorder(t){return $m.setFromEuler(this),this.setFromQuaternion($m,t)}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._order===this._order}fromArray(t){return this._x=t[0],this._y=t[1],this._z=t[2],t[3]!==void 0&&(this._order=t[3]),this._onChangeCallback(),this}toArray(t=[],e=0){return t[e]=this._x,t[e+1]=this._y,t[e+2]=this._z,t[e+3]=this._order,t}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._order}};Ps.DEFAULT_ORDER="XYZ";var To=class{constructor(){this.mask=1}set(t){this.mask=(1<<t|0)>>>0}enable(t){this.mask|=1<<t|0}enableAll(){this.mask=-1}toggle(t){this.mask^=1<<t|0}disable(t){this.mask&=~(1<<t|0)}disableAll(){this.mask=0}test(t){return(this.mask&t.mask)!==0}isEnabled(t){return(this.mask&(1<<t|0))!==0}},Sv=0,Km=new U,so=new en,bs=new te,Hl=new U,ba=new U,Mv=new U,bv=new en,Jm=new U(1,0,0),jm=new U(0,1,0),Qm=new U(0,0,1),tg={type:"added"},wv={type:"removed"},ro={type:"childadded",child:null},Lf={type:"childremoved",child:null},Wn=class i extends Vi{constructor(){super(),this.isObject3D=!0,Object.defineProperty(this,"id",{value:Sv++}),this.uuid=Bo(),this.name="",this.type="Object3D",this.parent=null,this.children=[],this.up=i.DEFAULT_UP.clone();let t=new U,e=new Ps,n=new en,s=new U(1,1,1);function r(){n.setFromEuler(e,!1)}function o(){e.setFromQuaternion(n,void 0,!1)}e._onChange(r),n._onChange(o),Object.defineProperties(this,{position:{configurable:!0,enumerable:!0,value:t},rotation:{configurable:!0,enumerable:!0,value:e},quaternion:{configurable:!0,enumerable:!0,value:n},scale:{configurable:!0,enumerable:!0,value:s},modelViewMatrix:{value:new te},normalMatrix:{value:new ie}}),this.matrix=new te,this.matrixWorld=new te,this.matrixAutoUpdate=i.DEFAULT_MATRIX_AUTO_UPDATE,this.matrixWorldAutoUpdate=i.DEFAULT_MATRIX_WORLD_AUTO_UPDATE,this.matrixWorldNeedsUpdate=!1,this.layers=new To,this.visible=!0,this.castShadow=!1,this.receiveShadow=!1,this.frustumCulled=!0,this.renderOrder=0,this.animations=[],this.customDepthMaterial=void 0,this.customDistanceMaterial=void 0,this.static=!1,this.userData={},this.pivot=null}onBeforeShadow(){}onAfterShadow(){}onBeforeRender(){}onAfterRender(){}applyMatrix4(t){this.matrixAutoUpdate&&this.updateMatrix(),this.matrix.premultiply(t),this.matrix.decompose(this.position,this.quaternion,this.scale),this.pivot!==null&&this.position.copy(this.pivot).applyMatrix4(this.matrix).sub(this.pivot)}applyQuaternion(t){return this.quaternion.premultiply(t),this}setRotationFromAxisAngle(t,e){this.quaternion.setFromAxisAngle(t,e)}setRotationFromEuler(t){this.quaternion.setFromEuler(t,!0)}setRotationFromMatrix(t){this.quaternion.setFromRotationMatrix(t)}setRotationFromQuaternion(t){this.quaternion.copy(t)}rotateOnAxis(t,e){return so.setFromAxisAngle(t,e),this.quaternion.multiply(so),this}rotateOnWorldAxis(t,e){return so.setFromAxisAngle(t,e),this.quaternion.premultiply(so),this}rotateX(t){return this.rotateOnAxis(Jm,t)}rotateY(t){return this.rotateOnAxis(jm,t)}rotateZ(t){return this.rotateOnAxis(Qm,t)}translateOnAxis(t,e){return Km.copy(t).applyQuaternion(this.quaternion),this.position.add(Km.multiplyScalar(e)),this}translateX(t){return this.translateOnAxis(Jm,t)}translateY(t){return this.translateOnAxis(jm,t)}translateZ(t){return this.translateOnAxis(Qm,t)}localToWorld(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(this.matrixWorld)}worldToLocal(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(bs.copy(this.matrixWorld).invert())}lookAt(t,e,n){t.isVector3?Hl.copy(t):Hl.set(t,e,n);let s=this.parent;this.updateWorldMatrix(!0,!1),ba.setFromMatrixPosition(this.matrixWorld),this.isCamera||this.isLight?bs.lookAt(ba,Hl,this.up):bs.lookAt(Hl,ba,this.up),this.quaternion.setFromRotationMatrix(bs),s&&(bs.extractRotation(s.matrixWorld),so.setFromRotationMatrix(bs),this.quaternion.premultiply(so.invert()))}add(t){if(arguments.length>1){for(let e=0;e<arguments.length;e++)this.add(arguments[e]);return this}return t===this?(Qt("Object3D.add: object can't be added as a child of itself.",t),this):(t&&t.isObject3D?(t.removeFromParent(),t.parent=this,this.children.push(t),t.dispatchEvent(tg),ro.child=t,this.dispatchEvent(ro),ro.child=null):Qt("Object3D.add: object not an instance of THREE.Object3D.",t),this)}remove(t){if(arguments.length>1){for(let n=0;n<arguments.length;n++)this.remove(arguments[n]);return this}let e=this.children.indexOf(t);return e!==-1&&(t.parent=null,this.children.splice(e,1),t.dispatchEvent(wv),Lf.child=t,this.dispatchEvent(Lf),Lf.child=null),this}removeFromParent(){let t=this.parent;return t!==null&&t.remove(this),this}clear(){return this.remove(...this.children)}attach(t){return this.updateWorldMatrix(!0,!1),bs.copy(this.matrixWorld).invert(),t.parent!==null&&(t.parent.updateWorldMatrix(!0,!1),bs.multiply(t.parent.matrixWorld)),t.applyMatrix4(bs),t.removeFromParent(),t.parent=this,this.children.push(t),t.updateWorldMatrix(!1,!0),t.dispatchEvent(tg),ro.child=t,this.dispatchEvent(ro),ro.child=null,this}getObjectById(t){return this.getObjectByProperty("id",t)}getObjectByName(t){return this.getObjectByProperty("name",t)}getObjectByProperty(t,e){if(this[t]===e)return this;for(let n=0,s=this.children.length;n<s;n++){let o=this.children[n].getObjectByProperty(t,e);if(o!==void 0)return o}}getObjectsByProperty(t,e,n=[]){this[t]===e&&n.push(this);let s=this.children;for(let r=0,o=s.length;r<o;r++)s[r].getObjectsByProperty(t,e,n);return n}getWorldPosition(t){return this.updateWorldMatrix(!0,!1),t.setFromMatrixPosition(this.matrixWorld)}getWorldQuaternion(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(ba,t,Mv),t}getWorldScale(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(ba,bv,t),t}getWorldDirection(t){this.updateWorldMatrix(!0,!1);let e=this.matrixWorld.elements;return t.set(e[8],e[9],e[10]).normalize()}raycast(){}intersectsFrustum(){return!0}traverse(t){t(this);let e=this.children;for(let n=0,s=e.length;n<s;n++)e[n].traverse(t)}traverseVisible(t){if(this.visible===!1)return;t(this);let e=this.children;for(let n=0,s=e.length;n<s;n++)e[n].traverseVisible(t)}traverseAncestors(t){let e=this.parent;e!==null&&(t(e),e.traverseAncestors(t))}updateMatrix(){this.matrix.compose(this.position,this.quaternion,this.scale);let t=this.pivot;if(t!==null){let e=t.x,n=t.y,s=t.z,r=this.matrix.elements;r[12]+=e-r[0]*e-r[4]*n-r[8]*s,r[13]+=n-r[1]*e-r[5]*n-r[9]*s,r[14]+=s-r[2]*e-r[6]*n-r[10]*s}this.matrixWorldNeedsUpdate=!0}updateMatrixWorld(t){this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||t)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,t=!0);let e=this.children;for(let n=0,s=e.length;n<s;n++)e[n].updateMatrixWorld(t)}updateWorldMatrix(t,e,n=!1){let s=this.parent;if(t===!0&&s!==null&&s.updateWorldMatrix(!0,!1),this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||n)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,n=!0),e===!0){let r=this.children;for(let o=0,a=r.length;o<a;o++)r[o].updateWorldMatrix(!1,!0,n)}}toJSON(t){let e=t===void 0||typeof t=="string",n={};e&&(t={geometries:{},materials:{},textures:{},images:{},shapes:{},skeletons:{},animations:{},nodes:{}},n.metadata={version:4.7,type:"Object",generator:"Object3D.toJSON"});let s={};s.uuid=this.uuid,s.type=this.type,s.name=this.name,s.castShadow=this.castShadow,s.receiveShadow=this.receiveShadow,s.visible=this.visible,s.frustumCulled=this.frustumCulled,s.renderOrder=this.renderOrder,s.static=this.static,s.matrixAutoUpdate=this.matrixAutoUpdate,Object.keys(this.userData).length>0&&(s.userData=this.userData),s.layers=this.layers.mask,s.matrix=this.matrix.toArray(),s.up=this.up.toArray(),this.pivot!==null&&(s.pivot=this.pivot.toArray()),this.morphTargetDictionary!==void 0&&(s.morphTargetDictionary=Object.assign({},this.morphTargetDictionary)),this.morphTargetInfluences!==void 0&&(s.morphTargetInfluences=this.morphTargetInfluences.slice()),this.isInstancedMesh&&(s.type="InstancedMesh",s.count=this.count,s.instanceMatrix=this.instanceMatrix.toJSON(),this.instanceColor!==null&&(s.instanceColor=this.instanceColor.toJSON())),this.isBatchedMesh&&(s.type="BatchedMesh",s.perObjectFrustumCulled=this.perObjectFrustumCulled,s.sortObjects=this.sortObjects,s.drawRanges=this._drawRanges,s.reservedRanges=this._reservedRanges,s.geometryInfo=this._geometryInfo.map(a=>({...a,boundingBox:a.boundingBox?a.boundingBox.toJSON():void 0,boundingSphere:a.boundingSphere?a.boundingSphere.toJSON():void 0})),s.instanceInfo=this._instanceInfo.map(a=>({...a})),s.availableInstanceIds=this._availableInstanceIds.slice(),s.availableGeometryIds=this._availableGeometryIds.slice(),s.nextIndexStart=this._nextIndexStart,s.nextVertexStart=this._nextVertexStart,s.geometryCount=this._geometryCount,s.maxInstanceCount=this._maxInstanceCount,s.maxVertexCount=this._maxVertexCount,s.maxIndexCount=this._maxIndexCount,s.geometryInitialized=this._geometryInitialized,s.matricesTexture=this._matricesTexture.toJSON(t),s.indirectTexture=this._indirectTexture.toJSON(t),this._colorsTexture!==null&&(s.colorsTexture=this._colorsTexture.toJSON(t)),this.boundingSphere!==null&&(s.boundingSphere=this.boundingSphere.toJSON()),this.boundingBox!==null&&(s.boundingBox=this.boundingBox.toJSON()));function r(a,l){return a[l.uuid]===void 0&&(a[l.uuid]=l.toJSON(t)),l.uuid}if(this.isScene)this.background&&(this.background.isColor?s.background=this.background.toJSON():this.background.isTexture&&(s.background=this.background.toJSON(t).uuid)),this.environment&&this.environment.isTexture&&this.environment.isRenderTargetTexture!==!0&&(s.environment=this.environment.toJSON(t).uuid);else if(this.isMesh||this.isLine||this.isPoints){s.geometry=r(t.geometries,this.geometry);let a=this.geometry.parameters;if(a!==void 0&&a.shapes!==void 0){let l=a.shapes;if(Array.isArray(l))for(let c=0,f=l.length;c<f;c++){let u=l[c];r(t.shapes,u)}else r(t.shapes,l)}}if(this.isSkinnedMesh&&(s.bindMode=this.bindMode,s.bindMatrix=this.bindMatrix.toArray(),this.skeleton!==void 0&&(r(t.skeletons,this.skeleton),s.skeleton=this.skeleton.uuid)),this.material!==void 0)if(Array.isArray(this.material)){let a=[];for(let l=0,c=this.material.length;l<c;l++)a.push(r(t.materials,this.material[l]));s.material=a}else s.material=r(t.materials,this.material);if(this.children.length>0){s.children=[];for(let a=0;a<this.children.length;a++)s.children.push(this.children[a].toJSON(t).object)}if(this.animations.length>0){s.animations=[];for(let a=0;a<this.animations.length;a++){let l=this.animations[a];s.animations.push(r(t.animations,l))}}if(e){let a=o(t.geometries),l=o(t.materials),c=o(t.textures),f=o(t.images),u=o(t.shapes),h=o(t.skeletons),d=o(t.animations),g=o(t.nodes);a.length>0&&(n.geometries=a),l.length>0&&(n.materials=l),c.length>0&&(n.textures=c),f.length>0&&(n.images=f),u.length>0&&(n.shapes=u),h.length>0&&(n.skeletons=h),d.length>0&&(n.animations=d),g.length>0&&(n.nodes=g)}return n.object=s,n;function o(a){let l=[];for(let c in a){let f=a[c];delete f.metadata,l.push(f)}return l}}clone(t){return new this.constructor().copy(this,t)}copy(t,e=!0){if(this.name=t.name,this.up.copy(t.up),this.position.copy(t.position),this.rotation.order=t.rotation.order,this.quaternion.copy(t.quaternion),this.scale.copy(t.scale),this.pivot=t.pivot!==null?t.pivot.clone():null,this.matrix.copy(t.matrix),this.matrixWorld.copy(t.matrixWorld),this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrixWorldAutoUpdate=t.matrixWorldAutoUpdate,this.matrixWorldNeedsUpdate=t.matrixWorldNeedsUpdate,this.layers.mask=t.layers.mask,this.visible=t.visible,this.castShadow=t.castShadow,this.receiveShadow=t.receiveShadow,this.frustumCulled=t.frustumCulled,this.renderOrder=t.renderOrder,this.static=t.static,this.animations=t.animations.slice(),this.userData=JSON.parse(JSON.stringify(t.userData)),e===!0)for(let n=0;n<t.children.length;n++){let s=t.children[n];this.add(s.clone())}return this}dispose(){this.dispatchEvent({type:"dispose"})}};Wn.DEFAULT_UP=new U(0,1,0);Wn.DEFAULT_MATRIX_AUTO_UPDATE=!0;Wn.DEFAULT_MATRIX_WORLD_AUTO_UPDATE=!0;var dn=class extends Wn{constructor(){super(),this.isGroup=!0,this.type="Group"}},Tv={type:"move"},Ao=class{constructor(){this._targetRay=null,this._grip=null,this._hand=null}getHandSpace(){return this._hand===null&&(this._hand=new dn,this._hand.matrixAutoUpdate=!1,this._hand.visible=!1,this._hand.joints={},this._hand.inputState={pinching:!1}),this._hand}getTargetRaySpace(){return this._targetRay===null&&(this._targetRay=new dn,this._targetRay.matrixAutoUpdate=!1,this._targetRay.visible=!1,this._targetRay.hasLinearVelocity=!1,this._targetRay.linearVelocity=new U,this._targetRay.hasAngularVelocity=!1,this._targetRay.angularVelocity=new U),this._targetRay}getGripSpace(){return this._grip===null&&(this._grip=new dn,this._grip.matrixAutoUpdate=!1,this._grip.visible=!1,this._grip.hasLinearVelocity=!1,this._grip.linearVelocity=new U,this._grip.hasAngularVelocity=!1,this._grip.angularVelocity=new U,this._grip.eventsEnabled=!1),this._grip}dispatchEvent(t){return this._targetRay!==null&&this._targetRay.dispatchEvent(t),this._grip!==null&&this._grip.dispatchEvent(t),this._hand!==null&&this._hand.dispatchEvent(t),this}connect(t){if(t&&t.hand){let e=this._hand;if(e)for(let n of t.hand.values())this._getHandJoint(e,n)}return this.dispatchEvent({type:"connected",data:t}),this}disconnect(t){return this.dispatchEvent({type:"disconnected",data:t}),this._targetRay!==null&&(this._targetRay.visible=!1),this._grip!==null&&(this._grip.visible=!1),this._hand!==null&&(this._hand.visible=!1),this}update(t,e,n){let s=null,r=null,o=null,a=this._targetRay,l=this._grip,c=this._hand;if(t&&e.session.visibilityState!=="visible-blurred"){if(c&&t.hand){o=!0;for(let v of t.hand.values()){let m=e.getJointPose(v,n),p=this._getHandJoint(c,v);m!==null&&(p.matrix.fromArray(m.transform.matrix),p.matrix.decompose(p.position,p.quaternion,p.scale),p.matrixWorldNeedsUpdate=!0,p.jointRadius=m.radius),p.visible=m!==null}let f=c.joints["index-finger-tip"],u=c.joints["thumb-tip"],h=f.position.distanceTo(u.position),d=.02,g=.005;c.inputState.pinching&&h>d+g?(c.inputState.pinching=!1,this.dispatchEvent({type:"pinchend",handedness:t.handedness,target:this})):!c.inputState.pinching&&h<=d-g&&(c.inputState.pinching=!0,this.dispatchEvent({type:"pinchstart",handedness:t.handedness,target:this}))}else l!==null&&t.gripSpace&&(r=e.getPose(t.gripSpace,n),r!==null&&(l.matrix.fromArray(r.transform.matrix),l.matrix.decompose(l.position,l.quaternion,l.scale),l.matrixWorldNeedsUpdate=!0,r.linearVelocity?(l.hasLinearVelocity=!0,l.linearVelocity.copy(r.linearVelocity)):l.hasLinearVelocity=!1,r.angularVelocity?(l.hasAngularVelocity=!0,l.angularVelocity.copy(r.angularVelocity)):l.hasAngularVelocity=!1,l.eventsEnabled&&l.dispatchEvent({type:"gripUpdated",data:t,target:this})));a!==null&&(s=e.getPose(t.targetRaySpace,n),s===null&&r!==null&&(s=r),s!==null&&(a.matrix.fromArray(s.transform.matrix),a.matrix.decompose(a.position,a.quaternion,a.scale),a.matrixWorldNeedsUpdate=!0,s.linearVelocity?(a.hasLinearVelocity=!0,a.linearVelocity.copy(s.linearVelocity)):a.hasLinearVelocity=!1,s.angularVelocity?(a.hasAngularVelocity=!0,a.angularVelocity.copy(s.angularVelocity)):a.hasAngularVelocity=!1,this.dispatchEvent(Tv)))}return a!==null&&(a.visible=s!==null),l!==null&&(l.visible=r!==null),c!==null&&(c.visible=o!==null),this}_getHandJoint(t,e){if(t.joints[e.jointName]===void 0){let n=new dn;n.matrixAutoUpdate=!1,n.visible=!1,t.joints[e.jointName]=n,t.add(n)}return t.joints[e.jointName]}},o0={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074},Ys={h:0,s:0,l:0},Wl={h:0,s:0,l:0};function Df(i,t,e){return e<0&&(e+=1),e>1&&(e-=1),e<1/6?i+(t-i)*6*e:e<1/2?t:e<2/3?i+(t-i)*6*(2/3-e):i}var $t=class{constructor(t,e,n){return this.isColor=!0,this.r=1,this.g=1,this.b=1,this.set(t,e,n)}set(t,e,n){if(e===void 0&&n===void 0){let s=t;s&&s.isColor?this.copy(s):typeof s=="number"?this.setHex(s):typeof s=="string"&&this.setStyle(s)}else this.setRGB(t,e,n);return this}setScalar(t){return this.r=t,this.g=t,this.b=t,this}setHex(t,e=yi){return t=Math.floor(t),this.r=(t>>16&255)/255,this.g=(t>>8&255)/255,this.b=(t&255)/255,xe.colorSpaceToWorking(this,e),this}setRGB(t,e,n,s=xe.workingColorSpace){return this.r=t,this.g=e,this.b=n,xe.colorSpaceToWorking(this,s),this}setHSL(t,e,n,s=xe.workingColorSpace){if(t=Dd(t,1),e=ae(e,0,1),n=ae(n,0,1),e===0)this.r=this.g=this.b=n;else{let r=n<=.5?n*(1+e):n+e-n*e,o=2*n-r;this.r=Df(o,r,t+1/3),this.g=Df(o,r,t),this.b=Df(o,r,t-1/3)}return xe.colorSpaceToWorking(this,s),this}setStyle(t,e=yi){function n(r){r!==void 0&&parseFloat(r)<1&&Yt("Color: Alpha component of "+t+" will be ignored.")}let s;if(s=/^(\w+)\(([^\)]*)\)/.exec(t)){let r,o=s[1],a=s[2];switch(o){case"rgb":case"rgba":if(r=/^\s*(\d+)\s*,\s*(\d+)\s*,\s*(\d+)\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setRGB(Math.min(255,parseInt(r[1],10))/255,Math.min(255,parseInt(r[2],10))/255,Math.min(255,parseInt(r[3],10))/255,e);if(r=/^\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setRGB(Math.min(100,parseFloat(r[1]))/100,Math.min(100,parseFloat(r[2]))/100,Math.min(100,parseFloat(r[3]))/100,e);break;case"hsl":case"hsla":if(r=/^\s*([+-]?(?:\d+(?:\.\d+)?|\.\d+))\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setHSL(parseFloat(r[1])/360,parseFloat(r[2])/100,parseFloat(r[3])/100,e);break;default:Yt("Color: Unknown color model "+t)}}else if(s=/^\#([A-Fa-f\d]+)$/.exec(t)){let r=s[1],o=r.length;if(o===3)return this.setRGB(parseInt(r.charAt(0),16)/15,parseInt(r.charAt(1),16)/15,parseInt(r.charAt(2),16)/15,e);if(o===6)return this.setHex(parseInt(r,16),e);Yt("Color: Invalid hex color "+t)}else if(t&&t.length>0)return this.setColorName(t,e);return this}setColorName(t,e=yi){let n=o0[t.toLowerCase()];return n!==void 0?this.setHex(n,e):Yt("Color: Unknown color "+t),this}clone(){return new this.constructor(this.r,this.g,this.b)}copy(t){return this.r=t.r,this.g=t.g,this.b=t.b,this}copySRGBToLinear(t){return this.r=Cs(t.r),this.g=Cs(t.g),this.b=Cs(t.b),this}copyLinearToSRGB(t){return this.r=yo(t.r),this.g=yo(t.g),this.b=yo(t.b),this}convertSRGBToLinear(){return this.copySRGBToLinear(this),this}convertLinearToSRGB(){return this.copyLinearToSRGB(this),this}getHex(t=yi){return xe.workingToColorSpace(Zn.copy(this),t),Math.round(ae(Zn.r*255,0,255))*65536+Math.round(ae(Zn.g*255,0,255))*256+Math.round(ae(Zn.b*255,0,255))}getHexString(t=yi){return("000000"+this.getHex(t).toString(16)).slice(-6)}getHSL(t,e=xe.workingColorSpace){xe.workingToColorSpace(Zn.copy(this),e);let n=Zn.r,s=Zn.g,r=Zn.b,o=Math.max(n,s,r),a=Math.min(n,s,r),l,c,f=(a+o)/2;if(a===o)l=0,c=0;else{let u=o-a;switch(c=f<=.5?u/(o+a):u/(2-o-a),o){case n:l=(s-r)/u+(s<r?6:0);break;case s:l=(r-n)/u+2;break;case r:l=(n-s)/u+4;break}l/=6}return t.h=l,t.s=c,t.l=f,t}getRGB(t,e=xe.workingColorSpace){return xe.workingToColorSpace(Zn.copy(this),e),t.r=Zn.r,t.g=Zn.g,t.b=Zn.b,t}getStyle(t=yi){xe.workingToColorSpace(Zn.copy(this),t);let e=Zn.r,n=Zn.g,s=Zn.b;return t!==yi?`color(${t} ${e.toFixed(3)} ${n.toFixed(3)} ${s.toFixed(3)})`:`rgb(${Math.round(e*255)},${Math.round(n*255)},${Math.round(s*255)})`}offsetHSL(t,e,n){return this.getHSL(Ys),this.setHSL(Ys.h+t,Ys.s+e,Ys.l+n)}add(t){return this.r+=t.r,this.g+=t.g,this.b+=t.b,this}addColors(t,e){return this.r=t.r+e.r,this.g=t.g+e.g,this.b=t.b+e.b,this}addScalar(t){return this.r+=t,this.g+=t,this.b+=t,this}sub(t){return this.r=Math.max(0,this.r-t.r),this.g=Math.max(0,this.g-t.g),this.b=Math.max(0,this.b-t.b),this}multiply(t){return this.r*=t.r,this.g*=t.g,this.b*=t.b,this}multiplyScalar(t){return this.r*=t,this.g*=t,this.b*=t,this}lerp(t,e){return this.r+=(t.r-this.r)*e,this.g+=(t.g-this.g)*e,this.b+=(t.b-this.b)*e,this}lerpColors(t,e,n){return this.r=t.r+(e.r-t.r)*n,this.g=t.g+(e.g-t.g)*n,this.b=t.b+(e.b-t.b)*n,this}lerpHSL(t,e){this.getHSL(Ys),t.getHSL(Wl);let n=La(Ys.h,Wl.h,e),s=La(Ys.s,Wl.s,e),r=La(Ys.l,Wl.l,e);return this.setHSL(n,s,r),this}setFromVector3(t){return this.r=t.x,this.g=t.y,this.b=t.z,this}applyMatrix3(t){let e=this.r,n=this.g,s=this.b,r=t.elements;return this.r=r[0]*e+r[3]*n+r[6]*s,this.g=r[1]*e+r[4]*n+r[7]*s,this.b=r[2]*e+r[5]*n+r[8]*s,this}equals(t){return t.r===this.r&&t.g===this.g&&t.b===this.b}fromArray(t,e=0){return this.r=t[e],this.g=t[e+1],this.b=t[e+2],this}toArray(t=[],e=0){return t[e]=this.r,t[e+1]=this.g,t[e+2]=this.b,t}fromBufferAttribute(t,e){return this.r=t.getX(e),this.g=t.getY(e),this.b=t.getZ(e),this}toJSON(){return this.getHex()}*[Symbol.iterator](){yield this.r,yield this.g,yield this.b}},Zn=new $t;$t.NAMES=o0;var Ba=class extends Wn{constructor(){super(),this.isScene=!0,this.type="Scene",this.background=null,this.environment=null,this.fog=null,this.backgroundBlurriness=0,this.backgroundIntensity=1,this.backgroundRotation=new Ps,this.environmentIntensity=1,this.environmentRotation=new Ps,this.overrideMaterial=null,typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}copy(t,e){return super.copy(t,e),this.background=t.background!==null?t.background.clone():null,this.environment=t.environment!==null?t.environment.clone():null,this.fog=t.fog!==null?t.fog.clone():null,this.backgroundBlurriness=t.backgroundBlurriness,this.backgroundIntensity=t.backgroundIntensity,this.backgroundRotation.copy(t.backgroundRotation),this.environmentIntensity=t.environmentIntensity,this.environmentRotation.copy(t.environmentRotation),this.overrideMaterial=t.overrideMaterial!==null?t.overrideMaterial.clone():null,this.matrixAutoUpdate=t.matrixAutoUpdate,this}toJSON(t){let e=super.toJSON(t);return this.fog!==null&&(e.object.fog=this.fog.toJSON()),e.object.backgroundBlurriness=this.backgroundBlurriness,e.object.backgroundIntensity=this.backgroundIntensity,e.object.backgroundRotation=this.backgroundRotation.toArray(),e.object.environmentIntensity=this.environmentIntensity,e.object.environmentRotation=this.environmentRotation.toArray(),e}},zi=new U,ws=new U,Nf=new U,Ts=new U,oo=new U,ao=new U,eg=new U,Uf=new U,Ff=new U,Of=new U,Bf=new nn,zf=new nn,kf=new nn,kn=class i{constructor(t=new U,e=new U,n=new U){this.a=t,this.b=e,this.c=n}static getNormal(t,e,n,s){s.subVectors(n,e),zi.subVectors(t,e),s.cross(zi);let r=s.lengthSq();return r>0?s.multiplyScalar(1/Math.sqrt(r)):s.set(0,0,0)}static getBarycoord(t,e,n,s,r){zi.subVectors(s,e),ws.subVectors(n,e),Nf.subVectors(t,e);let o=zi.dot(zi),a=zi.dot(ws),l=zi.dot(Nf),c=ws.dot(ws),f=ws.dot(Nf),u=o*c-a*a;if(u===0)return r.set(0,0,0),null;let h=1/u,d=(c*l-a*f)*h,g=(o*f-a*l)*h;return r.set(1-d-g,g,d)}static containsPoint(t,e,n,s){return this.getBarycoord(t,e,n,s,Ts)===null?!1:Ts.x>=0&&Ts.y>=0&&Ts.x+Ts.y<=1}static getInterpolation(t,e,n,s,r,o,a,l){return this.getBarycoord(t,e,n,s,Ts)===null?(l.x=0,l.y=0,"z"in l&&(l.z=0),"w"in l&&(l.w=0),null):(l.setScalar(0),l.addScaledVector(r,Ts.x),l.addScaledVector(o,Ts.y),l.addScaledVector(a,Ts.z),l)}static getInterpolatedAttribute(t,e,n,s,r,o){return Bf.setScalar(0),zf.setScalar(0),kf.setScalar(0),Bf.fromBufferAttribute(t,e),zf.fromBufferAttribute(t,n),kf.fromBufferAttribute(t,s),o.setScalar(0),o.addScaledVector(Bf,r.x),o.addScaledVector(zf,r.y),o.addScaledVector(kf,r.z),o}static isFrontFacing(t,e,n,s){return zi.subVectors(n,e),ws.subVectors(t,e),zi.cross(ws).dot(s)<0}set(t,e,n){return this.a.copy(t),this.b.copy(e),this.c.copy(n),this}setFromPointsAndIndices(t,e,n,s){return this.a.copy(t[e]),this.b.copy(t[n]),this.c.copy(t[s]),this}setFromAttributeAndIndices(t,e,n,s){return this.a.fromBufferAttribute(t,e),this.b.fromBufferAttribute(t,n),this.c.fromBufferAttribute(t,s),this}clone(){return new this.constructor().copy(this)}copy(t){return this.a.copy(t.a),this.b.copy(t.b),this.c.copy(t.c),this}getArea(){return zi.subVectors(this.c,this.b),ws.subVectors(this.a,this.b),zi.cross(ws).length()*.5}getMidpoint(t){return t.addVectors(this.a,this.b).add(this.c).multiplyScalar(1/3)}getNormal(t){return i.getNormal(this.a,this.b,this.c,t)}getPlane(t){return t.setFromCoplanarPoints(this.a,this.b,this.c)}getBarycoord(t,e){return i.getBarycoord(t,this.a,this.b,this.c,e)}getInterpolation(t,e,n,s,r){return i.getInterpolation(t,this.a,this.b,this.c,e,n,s,r)}containsPoint(t){return i.containsPoint(t,this.a,this.b,this.c)}isFrontFacing(t){return i.isFrontFacing(this.a,this.b,this.c,t)}intersectsBox(t){return t.intersectsTriangle(this)}closestPointToPoint(t,e){let n=this.a,s=this.b,r=this.c,o,a;oo.subVectors(s,n),ao.subVectors(r,n),Uf.subVectors(t,n);let l=oo.dot(Uf),c=ao.dot(Uf);if(l<=0&&c<=0)return e.copy(n);Ff.subVectors(t,s);let f=oo.dot(Ff),u=ao.dot(Ff);if(f>=0&&u<=f)return e.copy(s);let h=l*u-f*c;if(h<=0&&l>=0&&f<=0&&l-f>0)return o=l/(l-f),e.copy(n).addScaledVector(oo,o);Of.subVectors(t,r);let d=oo.dot(Of),g=ao.dot(Of);if(g>=0&&d<=g)return e.copy(r);let v=d*c-l*g;if(v<=0&&c>=0&&g<=0)return a=c/(c-g),e.copy(n).addScaledVector(ao,a);let m=f*g-d*u;if(m<=0&&u-f>=0&&d-g>=0)return eg.subVectors(r,s),a=(u-f)/(u-f+(d-g)),e.copy(s).addScaledVector(eg,a);let p=1/(m+v+h);return o=v*p,a=h*p,e.copy(n).addScaledVector(oo,o).addScaledVector(ao,a)}equals(t){return t.a.equals(this.a)&&t.b.equals(this.b)&&t.c.equals(this.c)}},Oe=class{constructor(t=new U(1/0,1/0,1/0),e=new U(-1/0,-1/0,-1/0)){this.isBox3=!0,this.min=t,this.max=e}set(t,e){return this.min.copy(t),this.max.copy(e),this}setFromArray(t){this.makeEmpty();for(let e=0,n=t.length;e<n;e+=3)this.expandByPoint(ki.fromArray(t,e));return this}setFromBufferAttribute(t){this.makeEmpty();for(let e=0,n=t.count;e<n;e++)this.expandByPoint(ki.fromBufferAttribute(t,e));return this}setFromPoints(t){this.makeEmpty();for(let e=0,n=t.length;e<n;e++)this.expandByPoint(t[e]);return this}setFromCenterAndSize(t,e){let n=ki.copy(e).multiplyScalar(.5);return this.min.copy(t).sub(n),this.max.copy(t).add(n),this}setFromObject(t,e=!1){return this.makeEmpty(),this.expandByObject(t,e)}clone(){return new this.constructor().copy(this)}copy(t){return this.min.copy(t.min),this.max.copy(t.max),this}makeEmpty(){return this.min.x=this.min.y=this.min.z=1/0,this.max.x=this.max.y=this.max.z=-1/0,this}isEmpty(){return this.max.x<this.min.x||this.max.y<this.min.y||this.max.z<this.min.z}getCenter(t){return this.isEmpty()?t.set(0,0,0):t.addVectors(this.min,this.max).multiplyScalar(.5)}getSize(t){return this.isEmpty()?t.set(0,0,0):t.subVectors(this.max,this.min)}expandByPoint(t){return this.min.min(t),this.max.max(t),this}expandByVector(t){return this.min.sub(t),this.max.add(t),this}expandByScalar(t){return this.min.addScalar(-t),this.max.addScalar(t),this}expandByObject(t,e=!1){t.updateWorldMatrix(!1,!1);let n=t.geometry;if(n!==void 0){let r=n.getAttribute("position");if(e===!0&&r!==void 0&&t.isInstancedMesh!==!0&&t.isBatchedMesh!==!0)for(let o=0,a=r.count;o<a;o++)t.isMesh===!0?t.getVertexPosition(o,ki):ki.fromBufferAttribute(r,o),ki.applyMatrix4(t.matrixWorld),this.expandByPoint(ki);else t.boundingBox!==void 0?(t.boundingBox===null&&t.computeBoundingBox(),Xl.copy(t.boundingBox)):(n.boundingBox===null&&n.computeBoundingBox(),Xl.copy(n.boundingBox)),Xl.applyMatrix4(t.matrixWorld),this.union(Xl)}let s=t.children;for(let r=0,o=s.length;r<o;r++)this.expandByObject(s[r],e);return this}containsPoint(t){return t.x>=this.min.x&&t.x<=this.max.x&&t.y>=this.min.y&&t.y<=this.max.y&&t.z>=this.min.z&&t.z<=this.max.z}containsBox(t){return this.min.x<=t.min.x&&t.max.x<=this.max.x&&this.min.y<=t.min.y&&t.max.y<=this.max.y&&this.min.z<=t.min.z&&t.max.z<=this.max.z}getParameter(t,e){return e.set((t.x-this.min.x)/(this.max.x-this.min.x),(t.y-this.min.y)/(this.max.y-this.min.y),(t.z-this.min.z)/(this.max.z-this.min.z))}intersectsBox(t){return t.max.x>=this.min.x&&t.min.x<=this.max.x&&t.max.y>=this.min.y&&t.min.y<=this.max.y&&t.max.z>=this.min.z&&t.min.z<=this.max.z}intersectsSphere(t){return this.clampPoint(t.center,ki),ki.distanceToSquared(t.center)<=t.radius*t.radius}intersectsPlane(t){let e,n;return t.normal.x>0?(e=t.normal.x*this.min.x,n=t.normal.x*this.max.x):(e=t.normal.x*this.max.x,n=t.normal.x*this.min.x),t.normal.y>0?(e+=t.normal.y*this.min.y,n+=t.normal.y*this.max.y):(e+=t.normal.y*this.max.y,n+=t.normal.y*this.min.y),t.normal.z>0?(e+=t.normal.z*this.min.z,n+=t.normal.z*this.max.z):(e+=t.normal.z*this.max.z,n+=t.normal.z*this.min.z),e<=-t.constant&&n>=-t.constant}intersectsTriangle(t){if(this.isEmpty())return!1;this.getCenter(wa),ql.subVectors(this.max,wa),lo.subVectors(t.a,wa),co.subVectors(t.b,wa),ho.subVectors(t.c,wa),Zs.subVectors(co,lo),$s.subVectors(ho,co),vr.subVectors(lo,ho);let e=[0,-Zs.z,Zs.y,0,-$s.z,$s.y,0,-vr.z,vr.y,Zs.z,0,-Zs.x,$s.z,0,-$s.x,vr.z,0,-vr.x,-Zs.y,Zs.x,0,-$s.y,$s.x,0,-vr.y,vr.x,0];return!Vf(e,lo,co,ho,ql)||(e=[1,0,0,0,1,0,0,0,1],!Vf(e,lo,co,ho,ql))?!1:(Yl.crossVectors(Zs,$s),e=[Yl.x,Yl.y,Yl.z],Vf(e,lo,co,ho,ql))}clampPoint(t,e){return e.copy(t).clamp(this.min,this.max)}distanceToPoint(t){return this.clampPoint(t,ki).distanceTo(t)}getBoundingSphere(t){return this.isEmpty()?t.makeEmpty():(this.getCenter(t.center),t.radius=this.getSize(ki).length()*.5),t}intersect(t){return this.min.max(t.min),this.max.min(t.max),this.isEmpty()&&this.makeEmpty(),this}union(t){return this.min.min(t.min),this.max.max(t.max),this}applyMatrix4(t){return this.isEmpty()?this:(As[0].set(this.min.x,this.min.y,this.min.z).applyMatrix4(t),As[1].set(this.min.x,this.min.y,this.max.z).applyMatrix4(t),As[2].set(this.min.x,this.max.y,this.min.z).applyMatrix4(t),As[3].set(this.min.x,this.max.y,this.max.z).applyMatrix4(t),As[4].set(this.max.x,this.min.y,this.min.z).applyMatrix4(t),As[5].set(this.max.x,this.min.y,this.max.z).applyMatrix4(t),As[6].set(this.max.x,this.max.y,this.min.z).applyMatrix4(t),As[7].set(this.max.x,this.max.y,this.max.z).applyMatrix4(t),this.setFromPoints(As),this)}translate(t){return this.min.add(t),this.max.add(t),this}equals(t){return t.min.equals(this.min)&&t.max.equals(this.max)}toJSON(){return{min:this.min.toArray(),max:this.max.toArray()}}fromJSON(t){return this.min.fromArray(t.min),this.max.fromArray(t.max),this}},As=[new U,new U,new U,new U,new U,new U,new U,new U],ki=new U,Xl=new Oe,lo=new U,co=new U,ho=new U,Zs=new U,$s=new U,vr=new U,wa=new U,ql=new U,Yl=new U,Sr=new U;function Vf(i,t,e,n,s){for(let r=0,o=i.length-3;r<=o;r+=3){Sr.fromArray(i,r);let a=s.x*Math.abs(Sr.x)+s.y*Math.abs(Sr.y)+s.z*Math.abs(Sr.z),l=t.dot(Sr),c=e.dot(Sr),f=n.dot(Sr);if(Math.max(-Math.max(l,c,f),Math.min(l,c,f))>a)return!1}return!0}var Mn=new U,Zl=new kt,Av=0,Je=class extends Vi{constructor(t,e,n=!1){if(super(),Array.isArray(t))throw new TypeError("THREE.BufferAttribute: array should be a Typed Array.");this.isBufferAttribute=!0,Object.defineProperty(this,"id",{value:Av++}),this.name="",this.array=t,this.itemSize=e,this.count=t!==void 0?t.length/e:0,this.normalized=n,this.usage=Qg,this.updateRanges=[],this.gpuType=ui,this.version=0,this._normalizationScale=t!==void 0?Ud(t):void 0}onUploadCallback(){}set needsUpdate(t){t===!0&&this.version++}setUsage(t){return this.usage=t,this}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}copy(t){return this.name=t.name,this.array=new t.array.constructor(t.array),this.itemSize=t.itemSize,this.count=t.count,this.normalized=t.normalized,this.usage=t.usage,this.gpuType=t.gpuType,this._normalizationScale=t._normalizationScale,this}copyAt(t,e,n){t*=this.itemSize,n*=e.itemSize;for(let s=0,r=this.itemSize;s<r;s++)this.array[t+s]=e.array[n+s];return this}copyArray(t){return this.array.set(t),this}applyMatrix3(t){if(this.itemSize===2)for(let e=0,n=this.count;e<n;e++)Zl.fromBufferAttribute(this,e),Zl.applyMatrix3(t),this.setXY(e,Zl.x,Zl.y);else if(this.itemSize===3)for(let e=0,n=this.count;e<n;e++)Mn.fromBufferAttribute(this,e),Mn.applyMatrix3(t),this.setXYZ(e,Mn.x,Mn.y,Mn.z);return this}applyMatrix4(t){for(let e=0,n=this.count;e<n;e++)Mn.fromBufferAttribute(this,e),Mn.applyMatrix4(t),this.setXYZ(e,Mn.x,Mn.y,Mn.z);return this}applyNormalMatrix(t){for(let e=0,n=this.count;e<n;e++)Mn.fromBufferAttribute(this,e),Mn.applyNormalMatrix(t),this.setXYZ(e,Mn.x,Mn.y,Mn.z);return this}transformDirection(t){for(let e=0,n=this.count;e<n;e++)Mn.fromBufferAttribute(this,e),Mn.transformDirection(t),this.setXYZ(e,Mn.x,Mn.y,Mn.z);return this}set(t,e=0){return this.array.set(t,e),this}getComponent(t,e){let n=this.array[t*this.itemSize+e];return this.normalized&&(n=this._denormalize(n)),n}setComponent(t,e,n){return this.normalized&&(n=this._normalize(n)),this.array[t*this.itemSize+e]=n,this}getX(t){let e=this.array[t*this.itemSize];return this.normalized&&(e=this._denormalize(e)),e}setX(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize]=e,this}getY(t){let e=this.array[t*this.itemSize+1];return this.normalized&&(e=this._denormalize(e)),e}setY(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+1]=e,this}getZ(t){let e=this.array[t*this.itemSize+2];return this.normalized&&(e=this._denormalize(e)),e}setZ(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+2]=e,this}getW(t){let e=this.array[t*this.itemSize+3];return this.normalized&&(e=this._denormalize(e)),e}setW(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+3]=e,this}setXY(t,e,n){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),n=this._normalize(n)),this.array[t+0]=e,this.array[t+1]=n,this}setXYZ(t,e,n,s){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),n=this._normalize(n),s=this._normalize(s)),this.array[t+0]=e,this.array[t+1]=n,this.array[t+2]=s,this}setXYZW(t,e,n,s,r){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),n=this._normalize(n),s=this._normalize(s),r=this._normalize(r)),this.array[t+0]=e,this.array[t+1]=n,this.array[t+2]=s,this.array[t+3]=r,this}onUpload(t){return this.onUploadCallback=t,this}clone(){return new this.constructor(this.array,this.itemSize).copy(this)}toJSON(){let t={itemSize:this.itemSize,type:this.array.constructor.name,array:Array.from(this.array),normalized:this.normalized};return t.name=this.name,t.usage=this.usage,t.gpuType=this.gpuType,t}dispose(){this.dispatchEvent({type:"dispose"})}_denormalize(t){let e=this._normalizationScale;return e!==void 0?Math.max(t/e,-1):s0(t,this.array)}_normalize(t){let e=this._normalizationScale;return e!==void 0?Math.round(t*e):r0(t,this.array)}};var za=class extends Je{constructor(t,e,n){super(new Uint16Array(t),e,n)}};var ka=class extends Je{constructor(t,e,n){super(new Uint32Array(t),e,n)}};var Xe=class extends Je{constructor(t,e,n){super(new Float32Array(t),e,n)}},Ev=new Oe,Ta=new U,Gf=new U,Is=class{constructor(t=new U,e=-1){this.isSphere=!0,this.center=t,this.radius=e}set(t,e){return this.center.copy(t),this.radius=e,this}setFromPoints(t,e){let n=this.center;e!==void 0?n.copy(e):Ev.setFromPoints(t).getCenter(n);let s=0;for(let r=0,o=t.length;r<o;r++)s=Math.max(s,n.distanceToSquared(t[r]));return this.radius=Math.sqrt(s),this}copy(t){return this.center.copy(t.center),this.radius=t.radius,this}isEmpty(){return this.radius<0}makeEmpty(){return this.center.set(0,0,0),this.radius=-1,this}containsPoint(t){return t.distanceToSquared(this.center)<=this.radius*this.radius}distanceToPoint(t){return t.distanceTo(this.center)-this.radius}intersectsSphere(t){let e=this.radius+t.radius;return t.center.distanceToSquared(this.center)<=e*e}intersectsBox(t){return t.intersectsSphere(this)}intersectsPlane(t){return Math.abs(t.distanceToPoint(this.center))<=this.radius}clampPoint(t,e){let n=this.center.distanceToSquared(t);return e.copy(t),n>this.radius*this.radius&&(e.sub(this.center).normalize(),e.multiplyScalar(this.radius).add(this.center)),e}getBoundingBox(t){return this.isEmpty()?(t.makeEmpty(),t):(t.set(this.center,this.center),t.expandByScalar(this.radius),t)}applyMatrix4(t){return this.center.applyMatrix4(t),this.radius=this.radius*t.getMaxScaleOnAxis(),this}translate(t){return this.center.add(t),this}expandByPoint(t){if(this.isEmpty())return this.center.copy(t),this.radius=0,this;Ta.subVectors(t,this.center);let e=Ta.lengthSq();if(e>this.radius*this.radius){let n=Math.sqrt(e),s=(n-this.radius)*.5;this.center.addScaledVector(Ta,s/n),this.radius+=s}return this}union(t){return t.isEmpty()?this:this.isEmpty()?(this.copy(t),this):(this.center.equals(t.center)===!0?this.radius=Math.max(this.radius,t.radius):(Gf.subVectors(t.center,this.center).setLength(t.radius),this.expandByPoint(Ta.copy(t.center).add(Gf)),this.expandByPoint(Ta.copy(t.center).sub(Gf))),this)}equals(t){return t.center.equals(this.center)&&t.radius===this.radius}clone(){return new this.constructor().copy(this)}toJSON(){return{radius:this.radius,center:this.center.toArray()}}fromJSON(t){return this.radius=t.radius,this.center.fromArray(t.center),this}},Cv=0,Pi=new te,Hf=new Wn,uo=new U,xi=new Oe,Aa=new Oe,zn=new U,pn=class i extends Vi{constructor(){super(),this.isBufferGeometry=!0,Object.defineProperty(this,"id",{value:Cv++}),this.uuid=Bo(),this.name="",this.type="BufferGeometry",this.index=null,this.indirect=null,this.indirectOffset=0,this.attributes={},this.morphAttributes={},this.morphTargetsRelative=!1,this.groups=[],this.boundingBox=null,this.boundingSphere=null,this.drawRange={start:0,count:1/0},this.userData={},this._transformed=!1}getIndex(){return this.index}setIndex(t){return Array.isArray(t)?this.index=new(Qy(t)?ka:za)(t,1):this.index=t,this}setIndirect(t,e=0){return this.indirect=t,this.indirectOffset=e,this}getIndirect(){return this.indirect}getAttribute(t){return this.attributes[t]}setAttribute(t,e){return this.attributes[t]=e,this}deleteAttribute(t){return delete this.attributes[t],this}hasAttribute(t){return this.attributes[t]!==void 0}addGroup(t,e,n=0){this.groups.push({start:t,count:e,materialIndex:n})}clearGroups(){this.groups=[]}setDrawRange(t,e){this.drawRange.start=t,this.drawRange.count=e}applyMatrix4(t){let e=this.attributes.position;e!==void 0&&(e.applyMatrix4(t),e.needsUpdate=!0);let n=this.attributes.normal;if(n!==void 0){let r=new ie().getNormalMatrix(t);n.applyNormalMatrix(r),n.needsUpdate=!0}let s=this.attributes.tangent;return s!==void 0&&(s.transformDirection(t),s.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this._transformed=!0,this}applyQuaternion(t){return Pi.makeRotationFromQuaternion(t),this.applyMatrix4(Pi),this}rotateX(t){return Pi.makeRotationX(t),this.applyMatrix4(Pi),this}rotateY(t){return Pi.makeRotationY(t),this.applyMatrix4(Pi),this}rotateZ(t){return Pi.makeRotationZ(t),this.applyMatrix4(Pi),this}translate(t,e,n){return Pi.makeTranslation(t,e,n),this.applyMatrix4(Pi),this}scale(t,e,n){return Pi.makeScale(t,e,n),this.applyMatrix4(Pi),this}lookAt(t){return Hf.lookAt(t),Hf.updateMatrix(),this.applyMatrix4(Hf.matrix),this}center(){return this.computeBoundingBox(),this.boundingBox.getCenter(uo).negate(),this.translate(uo.x,uo.y,uo.z),this}setFromPoints(t){let e=this.getAttribute("position");if(e===void 0){let n=[];for(let s=0,r=t.length;s<r;s++){let o=t[s];n.push(o.x,o.y,o.z||0)}this.setAttribute("position",new Xe(n,3))}else{let n=Math.min(t.length,e.count);for(let s=0;s<n;s++){let r=t[s];e.setXYZ(s,r.x,r.y,r.z||0)}t.length>e.count&&Yt("BufferGeometry: Buffer size too small for points data. Use .dispose() and create a new geometry."),e.needsUpdate=!0}return this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new Oe);let t=this.attributes.position,e=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){Qt("BufferGeometry.computeBoundingBox(): GLBufferAttribute requires a manual bounding box.",this),this.boundingBox.set(new U(-1/0,-1/0,-1/0),new U(1/0,1/0,1/0));return}if(t!==void 0){if(this.boundingBox.setFromBufferAttribute(t),e)for(let n=0,s=e.length;n<s;n++){let r=e[n];xi.setFromBufferAttribute(r),this.morphTargetsRelative?(zn.addVectors(this.boundingBox.min,xi.min),this.boundingBox.expandByPoint(zn),zn.addVectors(this.boundingBox.max,xi.max),this.boundingBox.expandByPoint(zn)):(this.boundingBox.expandByPoint(xi.min),this.boundingBox.expandByPoint(xi.max))}}else this.boundingBox.makeEmpty();(isNaN(this.boundingBox.min.x)||isNaN(this.boundingBox.min.y)||isNaN(this.boundingBox.min.z))&&Qt('BufferGeometry.computeBoundingBox(): Computed min/max have NaN values. The "position" attribute is likely to have NaN values.',this)}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new Is);let t=this.attributes.position,e=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){Qt("BufferGeometry.computeBoundingSphere(): GLBufferAttribute requires a manual bounding sphere.",this),this.boundingSphere.set(new U,1/0);return}if(t){let n=this.boundingSphere.center;if(xi.setFromBufferAttribute(t),e)for(let r=0,o=e.length;r<o;r++){let a=e[r];Aa.setFromBufferAttribute(a),this.morphTargetsRelative?(zn.addVectors(xi.min,Aa.min),xi.expandByPoint(zn),zn.addVectors(xi.max,Aa.max),xi.expandByPoint(zn)):(xi.expandByPoint(Aa.min),xi.expandByPoint(Aa.max))}xi.getCenter(n);let s=0;for(let r=0,o=t.count;r<o;r++)zn.fromBufferAttribute(t,r),s=Math.max(s,n.distanceToSquared(zn));if(e)for(let r=0,o=e.length;r<o;r++){let a=e[r],l=this.morphTargetsRelative;for(let c=0,f=a.count;c<f;c++)zn.fromBufferAttribute(a,c),l&&(uo.fromBufferAttribute(t,c),zn.add(uo)),s=Math.max(s,n.distanceToSquared(zn))}this.boundingSphere.radius=Math.sqrt(s),isNaN(this.boundingSphere.radius)&&Qt('BufferGeometry.computeBoundingSphere(): Computed radius is NaN. The "position" attribute is likely to have NaN values.',this)}}computeTangents(){let t=this.index,e=this.attributes;if(t===null||e.position===void 0||e.normal===void 0||e.uv===void 0){Qt("BufferGeometry: .computeTangents() failed. Missing required attributes (index, position, normal or uv)");return}let n=e.position,s=e.normal,r=e.uv,o=this.getAttribute("tangent");(o===void 0||o.count!==n.count)&&(o=new Je(new Float32Array(4*n.count),4),this.setAttribute("tangent",o));let a=[],l=[],c=new Uint8Array(n.count);for(let D=0;D<n.count;D++)a[D]=new U,l[D]=new U;let f=new U,u=new U,h=new U,d=new kt,g=new kt,v=new kt,m=new U,p=new U;function _(D,C,P){c[D]=c[C]=c[P]=1,f.fromBufferAttribute(n,D),u.fromBufferAttribute(n,C),h.fromBufferAttribute(n,P),d.fromBufferAttribute(r,D),g.fromBufferAttribute(r,C),v.fromBufferAttribute(r,P),u.sub(f),h.sub(f),g.sub(d),v.sub(d);let I=1/(g.x*v.y-v.x*g.y);isFinite(I)&&(m.copy(u).multiplyScalar(v.y).addScaledVector(h,-g.y).multiplyScalar(I),p.copy(h).multiplyScalar(g.x).addScaledVector(u,-v.x).multiplyScalar(I),a[D].add(m),a[C].add(m),a[P].add(m),l[D].add(p),l[C].add(p),l[P].add(p))}let M=this.groups;M.length===0&&(M=[{start:0,count:t.count}]);for(let D=0,C=M.length;D<C;++D){let P=M[D],I=P.start,O=P.count;for(let L=I,z=I+O;L<z;L+=3)_(t.getX(L+0),t.getX(L+1),t.getX(L+2))}let y=new U,w=new U,T=new U,x=new U;function b(D){T.fromBufferAttribute(s,D),x.copy(T);let C=a[D];y.copy(C),y.sub(T.multiplyScalar(T.dot(C))).normalize(),w.crossVectors(x,C);let I=w.dot(l[D])<0?-1:1;o.setXYZW(D,y.x,y.y,y.z,I)}for(let D=0,C=n.count;D<C;++D)c[D]&&b(D);this._transformed=!0}computeVertexNormals(){let t=this.index,e=this.getAttribute("position");if(e!==void 0){let n=this.getAttribute("normal");if(n===void 0||n.count!==e.count)n=new Je(new Float32Array(e.count*3),3),this.setAttribute("normal",n);else for(let h=0,d=n.count;h<d;h++)n.setXYZ(h,0,0,0);let s=new U,r=new U,o=new U,a=new U,l=new U,c=new U,f=new U,u=new U;if(t)for(let h=0,d=t.count;h<d;h+=3){let g=t.getX(h+0),v=t.getX(h+1),m=t.getX(h+2);s.fromBufferAttribute(e,g),r.fromBufferAttribute(e,v),o.fromBufferAttribute(e,m),f.subVectors(o,r),u.subVectors(s,r),f.cross(u),a.fromBufferAttribute(n,g),l.fromBufferAttribute(n,v),c.fromBufferAttribute(n,m),a.add(f),l.add(f),c.add(f),n.setXYZ(g,a.x,a.y,a.z),n.setXYZ(v,l.x,l.y,l.z),n.setXYZ(m,c.x,c.y,c.z)}else for(let h=0,d=e.count;h<d;h+=3)s.fromBufferAttribute(e,h+0),r.fromBufferAttribute(e,h+1),o.fromBufferAttribute(e,h+2),f.subVectors(o,r),u.subVectors(s,r),f.cross(u),n.setXYZ(h+0,f.x,f.y,f.z),n.setXYZ(h+1,f.x,f.y,f.z),n.setXYZ(h+2,f.x,f.y,f.z);this.normalizeNormals(),n.needsUpdate=!0}}normalizeNormals(){let t=this.attributes.normal;for(let e=0,n=t.count;e<n;e++)zn.fromBufferAttribute(t,e),zn.normalize(),t.setXYZ(e,zn.x,zn.y,zn.z)}toNonIndexed(){function t(a,l){let c=a.array,f=a.itemSize,u=a.normalized,h=new c.constructor(l.length*f),d=0,g=0;for(let v=0,m=l.length;v<m;v++){a.isInterleavedBufferAttribute?d=l[v]*a.data.stride+a.offset:d=l[v]*f;for(let p=0;p<f;p++)h[g++]=c[d++]}return new Je(h,f,u)}if(this.index===null)return Yt("BufferGeometry.toNonIndexed(): BufferGeometry is already non-indexed."),this;let e=new i,n=this.index.array,s=this.attributes;for(let a in s){let l=s[a],c=t(l,n);e.setAttribute(a,c)}let r=this.morphAttributes;for(let a in r){let l=[],c=r[a];for(let f=0,u=c.length;f<u;f++){let h=c[f],d=t(h,n);l.push(d)}e.morphAttributes[a]=l}e.morphTargetsRelative=this.morphTargetsRelative;let o=this.groups;for(let a=0,l=o.length;a<l;a++){let c=o[a];e.addGroup(c.start,c.count,c.materialIndex)}return e}toJSON(){let t={metadata:{version:4.7,type:"BufferGeometry",generator:"BufferGeometry.toJSON"}};if(t.uuid=this.uuid,t.type=this.parameters!==void 0&&this._transformed===!0?"BufferGeometry":this.type,t.name=this.name,Object.keys(this.userData).length>0&&(t.userData=this.userData),this.parameters!==void 0&&this._transformed!==!0){let l=this.parameters;for(let c in l)l[c]!==void 0&&(t[c]=l[c]);return t}t.data={attributes:{}};let e=this.index;e!==null&&(t.data.index={type:e.array.constructor.name,array:Array.prototype.slice.call(e.array)});let n=this.attributes;for(let l in n){let c=n[l];t.data.attributes[l]=c.toJSON(t.data)}let s={},r=!1;for(let l in this.morphAttributes){let c=this.morphAttributes[l],f=[];for(let u=0,h=c.length;u<h;u++){let d=c[u];f.push(d.toJSON(t.data))}f.length>0&&(s[l]=f,r=!0)}r&&(t.data.morphAttributes=s,t.data.morphTargetsRelative=this.morphTargetsRelative);let o=this.groups;o.length>0&&(t.data.groups=JSON.parse(JSON.stringify(o)));let a=this.boundingSphere;return a!==null&&(t.data.boundingSphere=a.toJSON()),t}clone(){return new this.constructor().copy(this)}copy(t){this.index=null,this.attributes={},this.morphAttributes={},this.groups=[],this.boundingBox=null,this.boundingSphere=null;let e={};this.name=t.name;let n=t.index;n!==null&&this.setIndex(n.clone());let s=t.attributes;for(let c in s){let f=s[c];this.setAttribute(c,f.clone(e))}let r=t.morphAttributes;for(let c in r){let f=[],u=r[c];for(let h=0,d=u.length;h<d;h++)f.push(u[h].clone(e));this.morphAttributes[c]=f}this.morphTargetsRelative=t.morphTargetsRelative;let o=t.groups;for(let c=0,f=o.length;c<f;c++){let u=o[c];this.addGroup(u.start,u.count,u.materialIndex)}let a=t.boundingBox;a!==null&&(this.boundingBox=a.clone());let l=t.boundingSphere;return l!==null&&(this.boundingSphere=l.clone()),this.drawRange.start=t.drawRange.start,this.drawRange.count=t.drawRange.count,this.userData=t.userData,this._transformed=t._transformed,this}dispose(){this.dispatchEvent({type:"dispose"})}};var Wf=new U,Rv=new U,Pv=new ie,An=class{constructor(t=new U(1,0,0),e=0){this.isPlane=!0,this.normal=t,this.constant=e}set(t,e){return this.normal.copy(t),this.constant=e,this}setComponents(t,e,n,s){return this.normal.set(t,e,n),this.constant=s,this}setFromNormalAndCoplanarPoint(t,e){return this.normal.copy(t),this.constant=-e.dot(this.normal),this}setFromCoplanarPoints(t,e,n){let s=Wf.subVectors(n,e).cross(Rv.subVectors(t,e)).normalize();return this.setFromNormalAndCoplanarPoint(s,t),this}copy(t){return this.normal.copy(t.normal),this.constant=t.constant,this}normalize(){let t=1/this.normal.length();return this.normal.multiplyScalar(t),this.constant*=t,this}negate(){return this.constant*=-1,this.normal.negate(),this}distanceToPoint(t){return this.normal.dot(t)+this.constant}distanceToSphere(t){return this.distanceToPoint(t.center)-t.radius}projectPoint(t,e){return e.copy(t).addScaledVector(this.normal,-this.distanceToPoint(t))}intersectLine(t,e,n=!0){let s=t.delta(Wf),r=this.normal.dot(s);if(r===0)return this.distanceToPoint(t.start)===0?e.copy(t.start):null;let o=-(t.start.dot(this.normal)+this.constant)/r;return n===!0&&(o<0||o>1)?null:e.copy(t.start).addScaledVector(s,o)}intersectsLine(t){let e=this.distanceToPoint(t.start),n=this.distanceToPoint(t.end);return e<0&&n>0||n<0&&e>0}intersectsBox(t){return t.intersectsPlane(this)}intersectsSphere(t){return t.intersectsPlane(this)}coplanarPoint(t){return t.copy(this.normal).multiplyScalar(-this.constant)}applyMatrix4(t,e){let n=e||Pv.getNormalMatrix(t),s=this.coplanarPoint(Wf).applyMatrix4(t),r=this.normal.applyMatrix3(n).normalize();return this.constant=-s.dot(r),this}translate(t){return this.constant-=t.dot(this.normal),this}equals(t){return t.normal.equals(this.normal)&&t.constant===this.constant}clone(){return new this.constructor().copy(this)}toJSON(){return{normal:this.normal.toArray(),constant:this.constant}}fromJSON(t){return this.normal.fromArray(t.normal),this.constant=t.constant,this}},Iv=0,Ls=class extends Vi{constructor(){super(),this.isMaterial=!0,Object.defineProperty(this,"id",{value:Iv++}),this.uuid=Bo(),this.name="",this.type="Material",this.blending=Do,this.side=Mi,this.vertexColors=!1,this.opacity=1,this.transparent=!1,this.alphaHash=!1,this.blendSrc=ld,this.blendDst=cd,this.blendEquation=Cr,this.blendSrcAlpha=null,this.blendDstAlpha=null,this.blendEquationAlpha=null,this.blendColor=new $t(0,0,0),this.blendAlpha=0,this.depthFunc=Js,this.depthTest=!0,this.depthWrite=!0,this.stencilWriteMask=255,this.stencilFunc=Ih,this.stencilRef=0,this.stencilFuncMask=255,this.stencilFail=dc,this.stencilZFail=dc,this.stencilZPass=dc,this.stencilWrite=!1,this.clippingPlanes=null,this.clipIntersection=!1,this.clipShadows=!1,this.shadowSide=null,this.colorWrite=!0,this.precision=null,this.polygonOffset=!1,this.polygonOffsetFactor=0,this.polygonOffsetUnits=0,this.dithering=!1,this.alphaToCoverage=!1,this.premultipliedAlpha=!1,this.forceSinglePass=!1,this.allowOverride=!0,this.visible=!0,this.toneMapped=!0,this.userData={},this.version=0,this._alphaTest=0}get alphaTest(){return this._alphaTest}set alphaTest(t){this._alphaTest>0!=t>0&&this.version++,this._alphaTest=t}onBeforeRender(){}onBeforeCompile(){}customProgramCacheKey(){return this.onBeforeCompile.toString()}setValues(t){if(t!==void 0)for(let e in t){let n=t[e];if(n===void 0){Yt(`Material: parameter '${e}' has value of undefined.`);continue}let s=this[e];if(s===void 0){Yt(`Material: '${e}' is not a property of THREE.${this.type}.`);continue}s&&s.isColor?s.set(n):s&&s.isVector2&&n&&n.isVector2||s&&s.isEuler&&n&&n.isEuler||s&&s.isVector3&&n&&n.isVector3?s.copy(n):this[e]=n}}toJSON(t){let e=t===void 0||typeof t=="string";e&&(t={textures:{},images:{}});let n={metadata:{version:4.7,type:"Material",generator:"Material.toJSON"}};n.uuid=this.uuid,n.type=this.type,n.blending=this.blending,n.side=this.side,n.shadowSide=this.shadowSide,n.vertexColors=this.vertexColors,n.opacity=this.opacity,n.transparent=this.transparent,n.blendSrc=this.blendSrc,n.blendDst=this.blendDst,n.blendEquation=this.blendEquation,n.blendSrcAlpha=this.blendSrcAlpha,n.blendDstAlpha=this.blendDstAlpha,n.blendEquationAlpha=this.blendEquationAlpha,n.blendColor=this.blendColor.getHex(),n.blendAlpha=this.blendAlpha,n.depthFunc=this.depthFunc,n.depthTest=this.depthTest,n.depthWrite=this.depthWrite,n.colorWrite=this.colorWrite,n.clipIntersection=this.clipIntersection,n.clipShadows=this.clipShadows,n.stencilWriteMask=this.stencilWriteMask,n.stencilFunc=this.stencilFunc,n.stencilRef=this.stencilRef,n.stencilFuncMask=this.stencilFuncMask,n.stencilFail=this.stencilFail,n.stencilZFail=this.stencilZFail,n.stencilZPass=this.stencilZPass,n.stencilWrite=this.stencilWrite,n.polygonOffset=this.polygonOffset,n.polygonOffsetFactor=this.polygonOffsetFactor,n.polygonOffsetUnits=this.polygonOffsetUnits,n.dithering=this.dithering,n.alphaTest=this.alphaTest,n.alphaHash=this.alphaHash,n.alphaToCoverage=this.alphaToCoverage,n.premultipliedAlpha=this.premultipliedAlpha,n.forceSinglePass=this.forceSinglePass,n.allowOverride=this.allowOverride,n.visible=this.visible,n.toneMapped=this.toneMapped,n.name=this.name,this.color&&this.color.isColor&&(n.color=this.color.getHex()),this.roughness!==void 0&&(n.roughness=this.roughness),this.metalness!==void 0&&(n.metalness=this.metalness),this.sheen!==void 0&&(n.sheen=this.sheen),this.sheenColor&&this.sheenColor.isColor&&(n.sheenColor=this.sheenColor.getHex()),this.sheenRoughness!==void 0&&(n.sheenRoughness=this.sheenRoughness),this.emissive&&this.emissive.isColor&&(n.emissive=this.emissive.getHex()),this.emissiveIntensity!==void 0&&(n.emissiveIntensity=this.emissiveIntensity),this.specular&&this.specular.isColor&&(n.specular=this.specular.getHex()),this.specularIntensity!==void 0&&(n.specularIntensity=this.specularIntensity),this.specularColor&&this.specularColor.isColor&&(n.specularColor=this.specularColor.getHex()),this.shininess!==void 0&&(n.shininess=this.shininess),this.clearcoat!==void 0&&(n.clearcoat=this.clearcoat),this.clearcoatRoughness!==void 0&&(n.clearcoatRoughness=this.clearcoatRoughness),this.diffuseRoughness!==void 0&&(n.diffuseRoughness=this.diffuseRoughness),this.diffuseRoughnessMap&&this.diffuseRoughnessMap.isTexture&&(n.diffuseRoughnessMap=this.diffuseRoughnessMap.toJSON(t).uuid),this.clearcoatMap&&this.clearcoatMap.isTexture&&(n.clearcoatMap=this.clearcoatMap.toJSON(t).uuid),this.clearcoatRoughnessMap&&this.clearcoatRoughnessMap.isTexture&&(n.clearcoatRoughnessMap=this.clearcoatRoughnessMap.toJSON(t).uuid),this.clearcoatNormalMap&&this.clearcoatNormalMap.isTexture&&(n.clearcoatNormalMap=this.clearcoatNormalMap.toJSON(t).uuid,n.clearcoatNormalScale=this.clearcoatNormalScale.toArray()),this.sheenColorMap&&this.sheenColorMap.isTexture&&(n.sheenColorMap=this.sheenColorMap.toJSON(t).uuid),this.sheenRoughnessMap&&this.sheenRoughnessMap.isTexture&&(n.sheenRoughnessMap=this.sheenRoughnessMap.toJSON(t).uuid),this.dispersion!==void 0&&(n.dispersion=this.dispersion),this.retroreflectivity!==void 0&&(n.retroreflectivity=this.retroreflectivity),this.iridescence!==void 0&&(n.iridescence=this.iridescence),this.iridescenceIOR!==void 0&&(n.iridescenceIOR=this.iridescenceIOR),this.iridescenceThicknessMinimum!==void 0&&(n.iridescenceThicknessMinimum=this.iridescenceThicknessMinimum),this.iridescenceThicknessMaximum!==void 0&&(n.iridescenceThicknessMaximum=this.iridescenceThicknessMaximum),this.iridescenceMap&&this.iridescenceMap.isTexture&&(n.iridescenceMap=this.iridescenceMap.toJSON(t).uuid),this.iridescenceThicknessMap&&this.iridescenceThicknessMap.isTexture&&(n.iridescenceThicknessMap=this.iridescenceThicknessMap.toJSON(t).uuid),this.anisotropy!==void 0&&(n.anisotropy=this.anisotropy),this.anisotropyRotation!==void 0&&(n.anisotropyRotation=this.anisotropyRotation),this.anisotropyMap&&this.anisotropyMap.isTexture&&(n.anisotropyMap=this.anisotropyMap.toJSON(t).uuid),this.map&&this.map.isTexture&&(n.map=this.map.toJSON(t).uuid),this.matcap&&this.matcap.isTexture&&(n.matcap=this.matcap.toJSON(t).uuid),this.alphaMap&&this.alphaMap.isTexture&&(n.alphaMap=this.alphaMap.toJSON(t).uuid),this.lightMap&&this.lightMap.isTexture&&(n.lightMap=this.lightMap.toJSON(t).uuid,n.lightMapIntensity=this.lightMapIntensity),this.aoMap&&this.aoMap.isTexture&&(n.aoMap=this.aoMap.toJSON(t).uuid,n.aoMapIntensity=this.aoMapIntensity),this.bumpMap&&this.bumpMap.isTexture&&(n.bumpMap=this.bumpMap.toJSON(t).uuid,n.bumpScale=this.bumpScale),this.normalMap&&this.normalMap.isTexture&&(n.normalMap=this.normalMap.toJSON(t).uuid,n.normalMapType=this.normalMapType,n.normalScale=this.normalScale.toArray()),this.displacementMap&&this.displacementMap.isTexture&&(n.displacementMap=this.displacementMap.toJSON(t).uuid,n.displacementScale=this.displacementScale,n.displacementBias=this.displacementBias),this.roughnessMap&&this.roughnessMap.isTexture&&(n.roughnessMap=this.roughnessMap.toJSON(t).uuid),this.metalnessMap&&this.metalnessMap.isTexture&&(n.metalnessMap=this.metalnessMap.toJSON(t).uuid),this.emissiveMap&&this.emissiveMap.isTexture&&(n.emissiveMap=this.emissiveMap.toJSON(t).uuid),this.specularMap&&this.specularMap.isTexture&&(n.specularMap=this.specularMap.toJSON(t).uuid),this.specularIntensityMap&&this.specularIntensityMap.isTexture&&(n.specularIntensityMap=this.specularIntensityMap.toJSON(t).uuid),this.specularColorMap&&this.specularColorMap.isTexture&&(n.specularColorMap=this.specularColorMap.toJSON(t).uuid),this.envMap&&this.envMap.isTexture&&(n.envMap=this.envMap.toJSON(t).uuid,this.combine!==void 0&&(n.combine=this.combine)),this.envMapRotation!==void 0&&(n.envMapRotation=this.envMapRotation.toArray()),this.envMapIntensity!==void 0&&(n.envMapIntensity=this.envMapIntensity),this.reflectivity!==void 0&&(n.reflectivity=this.reflectivity),this.refractionRatio!==void 0&&(n.refractionRatio=this.refractionRatio),this.gradientMap&&this.gradientMap.isTexture&&(n.gradientMap=this.gradientMap.toJSON(t).uuid),this.transmission!==void 0&&(n.transmission=this.transmission),this.transmissionMap&&this.transmissionMap.isTexture&&(n.transmissionMap=this.transmissionMap.toJSON(t).uuid),this.thickness!==void 0&&(n.thickness=this.thickness),this.thicknessMap&&this.thicknessMap.isTexture&&(n.thicknessMap=this.thicknessMap.toJSON(t).uuid),this.attenuationDistance!==void 0&&(n.attenuationDistance=this.attenuationDistance),this.attenuationColor!==void 0&&(n.attenuationColor=this.attenuationColor.getHex()),this.size!==void 0&&(n.size=this.size),this.sizeAttenuation!==void 0&&(n.sizeAttenuation=this.sizeAttenuation),Array.isArray(this.clippingPlanes)&&this.clippingPlanes.length>0&&(n.clippingPlanes=this.clippingPlanes.map(r=>r.toJSON())),this.rotation!==void 0&&(n.rotation=this.rotation),this.depthPacking!==void 0&&(n.depthPacking=this.depthPacking),this.linewidth!==void 0&&(n.linewidth=this.linewidth),this.linecap!==void 0&&(n.linecap=this.linecap),this.linejoin!==void 0&&(n.linejoin=this.linejoin),this.dashSize!==void 0&&(n.dashSize=this.dashSize),this.gapSize!==void 0&&(n.gapSize=this.gapSize),this.scale!==void 0&&(n.scale=this.scale),this.wireframe!==void 0&&(n.wireframe=this.wireframe),this.wireframeLinewidth!==void 0&&(n.wireframeLinewidth=this.wireframeLinewidth),this.wireframeLinecap!==void 0&&(n.wireframeLinecap=this.wireframeLinecap),this.wireframeLinejoin!==void 0&&(n.wireframeLinejoin=this.wireframeLinejoin),this.flatShading!==void 0&&(n.flatShading=this.flatShading),this.fog!==void 0&&(n.fog=this.fog),Object.keys(this.userData).length>0&&(n.userData=this.userData);function s(r){let o=[];for(let a in r){let l=r[a];delete l.metadata,o.push(l)}return o}if(e){let r=s(t.textures),o=s(t.images);r.length>0&&(n.textures=r),o.length>0&&(n.images=o)}return n}fromJSON(t,e){if(t.uuid!==void 0&&(this.uuid=t.uuid),t.name!==void 0&&(this.name=t.name),t.color!==void 0&&this.color!==void 0&&this.color.setHex(t.color),t.roughness!==void 0&&(this.roughness=t.roughness),t.metalness!==void 0&&(this.metalness=t.metalness),t.sheen!==void 0&&(this.sheen=t.sheen),t.sheenColor!==void 0&&(this.sheenColor=new $t().setHex(t.sheenColor)),t.sheenRoughness!==void 0&&(this.sheenRoughness=t.sheenRoughness),t.emissive!==void 0&&this.emissive!==void 0&&this.emissive.setHex(t.emissive),t.specular!==void 0&&this.specular!==void 0&&this.specular.setHex(t.specular),t.specularIntensity!==void 0&&(this.specularIntensity=t.specularIntensity),t.specularColor!==void 0&&this.specularColor!==void 0&&this.specularColor.setHex(t.specularColor),t.shininess!==void 0&&(this.shininess=t.shininess),t.clearcoat!==void 0&&(this.clearcoat=t.clearcoat),t.clearcoatRoughness!==void 0&&(this.clearcoatRoughness=t.clearcoatRoughness),t.diffuseRoughness!==void 0&&(this.diffuseRoughness=t.diffuseRoughness),t.dispersion!==void 0&&(this.dispersion=t.dispersion),t.retroreflectivity!==void 0&&(this.retroreflectivity=t.retroreflectivity),t.iridescence!==void 0&&(this.iridescence=t.iridescence),t.iridescenceIOR!==void 0&&(this.iridescenceIOR=t.iridescenceIOR),t.iridescenceThicknessMinimum!==void 0&&(this.iridescenceThicknessMinimum=t.iridescenceThicknessMinimum),t.iridescenceThicknessMaximum!==void 0&&(this.iridescenceThicknessMaximum=t.iridescenceThicknessMaximum),t.iridescenceThicknessRange!==void 0&&(this.iridescenceThicknessMinimum=t.iridescenceThicknessRange[0],this.iridescenceThicknessMaximum=t.iridescenceThicknessRange[1]),t.transmission!==void 0&&(this.transmission=t.transmission),t.thickness!==void 0&&(this.thickness=t.thickness),t.attenuationDistance!==void 0&&(this.attenuationDistance=t.attenuationDistance),t.attenuationColor!==void 0&&this.attenuationColor!==void 0&&this.attenuationColor.setHex(t.attenuationColor),t.anisotropy!==void 0&&(this.anisotropy=t.anisotropy),t.anisotropyRotation!==void 0&&(this.anisotropyRotation=t.anisotropyRotation),t.fog!==void 0&&(this.fog=t.fog),t.flatShading!==void 0&&(this.flatShading=t.flatShading),t.blending!==void 0&&(this.blending=t.blending),t.combine!==void 0&&(this.combine=t.combine),t.side!==void 0&&(this.side=t.side),t.shadowSide!==void 0&&(this.shadowSide=t.shadowSide),t.opacity!==void 0&&(this.opacity=t.opacity),t.transparent!==void 0&&(this.transparent=t.transparent),t.alphaTest!==void 0&&(this.alphaTest=t.alphaTest),t.alphaHash!==void 0&&(this.alphaHash=t.alphaHash),t.depthFunc!==void 0&&(this.depthFunc=t.depthFunc),t.depthTest!==void 0&&(this.depthTest=t.depthTest),t.depthWrite!==void 0&&(this.depthWrite=t.depthWrite),t.colorWrite!==void 0&&(this.colorWrite=t.colorWrite),t.clippingPlanes!==void 0&&(this.clippingPlanes=t.clippingPlanes.map(n=>new An().fromJSON(n))),t.clipIntersection!==void 0&&(this.clipIntersection=t.clipIntersection),t.clipShadows!==void 0&&(this.clipShadows=t.clipShadows),t.depthPacking!==void 0&&(this.depthPacking=t.depthPacking),t.blendSrc!==void 0&&(this.blendSrc=t.blendSrc),t.blendDst!==void 0&&(this.blendDst=t.blendDst),t.blendEquation!==void 0&&(this.blendEquation=t.blendEquation),t.blendSrcAlpha!==void 0&&(this.blendSrcAlpha=t.blendSrcAlpha),t.blendDstAlpha!==void 0&&(this.blendDstAlpha=t.blendDstAlpha),t.blendEquationAlpha!==void 0&&(this.blendEquationAlpha=t.blendEquationAlpha),t.blendColor!==void 0&&this.blendColor!==void 0&&this.blendColor.setHex(t.blendColor),t.blendAlpha!==void 0&&(this.blendAlpha=t.blendAlpha),t.stencilWriteMask!==void 0&&(this.stencilWriteMask=t.stencilWriteMask),t.stencilFunc!==void 0&&(this.stencilFunc=t.stencilFunc),t.stencilRef!==void 0&&(this.stencilRef=t.stencilRef),t.stencilFuncMask!==void 0&&(this.stencilFuncMask=t.stencilFuncMask),t.stencilFail!==void 0&&(this.stencilFail=t.stencilFail),t.stencilZFail!==void 0&&(this.stencilZFail=t.stencilZFail),t.stencilZPass!==void 0&&(this.stencilZPass=t.stencilZPass),t.stencilWrite!==void 0&&(this.stencilWrite=t.stencilWrite),t.wireframe!==void 0&&(this.wireframe=t.wireframe),t.wireframeLinewidth!==void 0&&(this.wireframeLinewidth=t.wireframeLinewidth),t.wireframeLinecap!==void 0&&(this.wireframeLinecap=t.wireframeLinecap),t.wireframeLinejoin!==void 0&&(this.wireframeLinejoin=t.wireframeLinejoin),t.rotation!==void 0&&(this.rotation=t.rotation),t.linewidth!==void 0&&(this.linewidth=t.linewidth),t.linecap!==void 0&&(this.linecap=t.linecap),t.linejoin!==void 0&&(this.linejoin=t.linejoin),t.dashSize!==void 0&&(this.dashSize=t.dashSize),t.gapSize!==void 0&&(this.gapSize=t.gapSize),t.scale!==void 0&&(this.scale=t.scale),t.polygonOffset!==void 0&&(this.polygonOffset=t.polygonOffset),t.polygonOffsetFactor!==void 0&&(this.polygonOffsetFactor=t.polygonOffsetFactor),t.polygonOffsetUnits!==void 0&&(this.polygonOffsetUnits=t.polygonOffsetUnits),t.dithering!==void 0&&(this.dithering=t.dithering),t.alphaToCoverage!==void 0&&(this.alphaToCoverage=t.alphaToCoverage),t.premultipliedAlpha!==void 0&&(this.premultipliedAlpha=t.premultipliedAlpha),t.forceSinglePass!==void 0&&(this.forceSinglePass=t.forceSinglePass),t.allowOverride!==void 0&&(this.allowOverride=t.allowOverride),t.visible!==void 0&&(this.visible=t.visible),t.toneMapped!==void 0&&(this.toneMapped=t.toneMapped),t.userData!==void 0&&(this.userData=t.userData),t.vertexColors!==void 0&&(typeof t.vertexColors=="number"?this.vertexColors=t.vertexColors>0:this.vertexColors=t.vertexColors),t.size!==void 0&&(this.size=t.size),t.sizeAttenuation!==void 0&&(this.sizeAttenuation=t.sizeAttenuation),t.map!==void 0&&(this.map=e[t.map]||null),t.matcap!==void 0&&(this.matcap=e[t.matcap]||null),t.alphaMap!==void 0&&(this.alphaMap=e[t.alphaMap]||null),t.bumpMap!==void 0&&(this.bumpMap=e[t.bumpMap]||null),t.bumpScale!==void 0&&(this.bumpScale=t.bumpScale),t.normalMap!==void 0&&(this.normalMap=e[t.normalMap]||null),t.normalMapType!==void 0&&(this.normalMapType=t.normalMapType),t.normalScale!==void 0){let n=t.normalScale;Array.isArray(n)===!1&&(n=[n,n]),this.normalScale=new kt().fromArray(n)}return t.displacementMap!==void 0&&(this.displacementMap=e[t.displacementMap]||null),t.displacementScale!==void 0&&(this.displacementScale=t.displacementScale),t.displacementBias!==void 0&&(this.displacementBias=t.displacementBias),t.roughnessMap!==void 0&&(this.roughnessMap=e[t.roughnessMap]||null),t.metalnessMap!==void 0&&(this.metalnessMap=e[t.metalnessMap]||null),t.emissiveMap!==void 0&&(this.emissiveMap=e[t.emissiveMap]||null),t.emissiveIntensity!==void 0&&(this.emissiveIntensity=t.emissiveIntensity),t.specularMap!==void 0&&(this.specularMap=e[t.specularMap]||null),t.specularIntensityMap!==void 0&&(this.specularIntensityMap=e[t.specularIntensityMap]||null),t.specularColorMap!==void 0&&(this.specularColorMap=e[t.specularColorMap]||null),t.envMap!==void 0&&(this.envMap=e[t.envMap]||null),t.envMapRotation!==void 0&&this.envMapRotation.fromArray(t.envMapRotation),t.envMapIntensity!==void 0&&(this.envMapIntensity=t.envMapIntensity),t.reflectivity!==void 0&&(this.reflectivity=t.reflectivity),t.refractionRatio!==void 0&&(this.refractionRatio=t.refractionRatio),t.lightMap!==void 0&&(this.lightMap=e[t.lightMap]||null),t.lightMapIntensity!==void 0&&(this.lightMapIntensity=t.lightMapIntensity),t.aoMap!==void 0&&(this.aoMap=e[t.aoMap]||null),t.aoMapIntensity!==void 0&&(this.aoMapIntensity=t.aoMapIntensity),t.gradientMap!==void 0&&(this.gradientMap=e[t.gradientMap]||null),t.clearcoatMap!==void 0&&(this.clearcoatMap=e[t.clearcoatMap]||null),t.clearcoatRoughnessMap!==void 0&&(this.clearcoatRoughnessMap=e[t.clearcoatRoughnessMap]||null),t.clearcoatNormalMap!==void 0&&(this.clearcoatNormalMap=e[t.clearcoatNormalMap]||null),t.clearcoatNormalScale!==void 0&&(this.clearcoatNormalScale=new kt().fromArray(t.clearcoatNormalScale)),t.diffuseRoughnessMap!==void 0&&(this.diffuseRoughnessMap=e[t.diffuseRoughnessMap]||null),t.iridescenceMap!==void 0&&(this.iridescenceMap=e[t.iridescenceMap]||null),t.iridescenceThicknessMap!==void 0&&(this.iridescenceThicknessMap=e[t.iridescenceThicknessMap]||null),t.transmissionMap!==void 0&&(this.transmissionMap=e[t.transmissionMap]||null),t.thicknessMap!==void 0&&(this.thicknessMap=e[t.thicknessMap]||null),t.anisotropyMap!==void 0&&(this.anisotropyMap=e[t.anisotropyMap]||null),t.sheenColorMap!==void 0&&(this.sheenColorMap=e[t.sheenColorMap]||null),t.sheenRoughnessMap!==void 0&&(this.sheenRoughnessMap=e[t.sheenRoughnessMap]||null),this}clone(){return new this.constructor().copy(this)}copy(t){this.name=t.name,this.blending=t.blending,this.side=t.side,this.vertexColors=t.vertexColors,this.opacity=t.opacity,this.transparent=t.transparent,this.blendSrc=t.blendSrc,this.blendDst=t.blendDst,this.blendEquation=t.blendEquation,this.blendSrcAlpha=t.blendSrcAlpha,this.blendDstAlpha=t.blendDstAlpha,this.blendEquationAlpha=t.blendEquationAlpha,this.blendColor.copy(t.blendColor),this.blendAlpha=t.blendAlpha,this.depthFunc=t.depthFunc,this.depthTest=t.depthTest,this.depthWrite=t.depthWrite,this.stencilWriteMask=t.stencilWriteMask,this.stencilFunc=t.stencilFunc,this.stencilRef=t.stencilRef,this.stencilFuncMask=t.stencilFuncMask,this.stencilFail=t.stencilFail,this.stencilZFail=t.stencilZFail,this.stencilZPass=t.stencilZPass,this.stencilWrite=t.stencilWrite;let e=t.clippingPlanes,n=null;if(e!==null){let s=e.length;n=new Array(s);for(let r=0;r!==s;++r)n[r]=e[r].clone()}return this.clippingPlanes=n,this.clipIntersection=t.clipIntersection,this.clipShadows=t.clipShadows,this.shadowSide=t.shadowSide,this.colorWrite=t.colorWrite,this.precision=t.precision,this.polygonOffset=t.polygonOffset,this.polygonOffsetFactor=t.polygonOffsetFactor,this.polygonOffsetUnits=t.polygonOffsetUnits,this.dithering=t.dithering,this.alphaTest=t.alphaTest,this.alphaHash=t.alphaHash,this.alphaToCoverage=t.alphaToCoverage,this.premultipliedAlpha=t.premultipliedAlpha,this.forceSinglePass=t.forceSinglePass,this.allowOverride=t.allowOverride,this.visible=t.visible,this.toneMapped=t.toneMapped,this.userData=JSON.parse(JSON.stringify(t.userData)),this}dispose(){this.dispatchEvent({type:"dispose"})}set needsUpdate(t){t===!0&&this.version++}};var Es=new U,Xf=new U,$l=new U,Kl=new U,os=class{constructor(t=new U,e=new U(0,0,-1)){this.origin=t,this.direction=e}set(t,e){return this.origin.copy(t),this.direction.copy(e),this}copy(t){return this.origin.copy(t.origin),this.direction.copy(t.direction),this}at(t,e){return e.copy(this.origin).addScaledVector(this.direction,t)}lookAt(t){return this.direction.copy(t).sub(this.origin).normalize(),this}recast(t){return this.origin.copy(this.at(t,Es)),this}closestPointToPoint(t,e){e.subVectors(t,this.origin);let n=e.dot(this.direction);return n<0?e.copy(this.origin):e.copy(this.origin).addScaledVector(this.direction,n)}distanceToPoint(t){return Math.sqrt(this.distanceSqToPoint(t))}distanceSqToPoint(t){let e=Es.subVectors(t,this.origin).dot(this.direction);return e<0?this.origin.distanceToSquared(t):(Es.copy(this.origin).addScaledVector(this.direction,e),Es.distanceToSquared(t))}distanceSqToSegment(t,e,n,s){Xf.copy(t).add(e).multiplyScalar(.5),$l.copy(e).sub(t).normalize(),Kl.copy(this.origin).sub(Xf);let r=t.distanceTo(e)*.5,o=-this.direction.dot($l),a=Kl.dot(this.direction),l=-Kl.dot($l),c=Kl.lengthSq(),f=Math.abs(1-o*o),u,h,d,g;if(f>0)if(u=o*l-a,h=o*a-l,g=r*f,u>=0)if(h>=-g)if(h<=g){let v=1/f;u*=v,h*=v,d=u*(u+o*h+2*a)+h*(o*u+h+2*l)+c}else h=r,u=Math.max(0,-(o*h+a)),d=-u*u+h*(h+2*l)+c;else h=-r,u=Math.max(0,-(o*h+a)),d=-u*u+h*(h+2*l)+c;else h<=-g?(u=Math.max(0,-(-o*r+a)),h=u>0?-r:Math.min(Math.max(-r,-l),r),d=-u*u+h*(h+2*l)+c):h<=g?(u=0,h=Math.min(Math.max(-r,-l),r),d=h*(h+2*l)+c):(u=Math.max(0,-(o*r+a)),h=u>0?r:Math.min(Math.max(-r,-l),r),d=-u*u+h*(h+2*l)+c);else h=o>0?-r:r,u=Math.max(0,-(o*h+a)),d=-u*u+h*(h+2*l)+c;return n&&n.copy(this.origin).addScaledVector(this.direction,u),s&&s.copy(Xf).addScaledVector($l,h),d}intersectSphere(t,e){if(t.radius<0)return null;Es.subVectors(t.center,this.origin);let n=Es.dot(this.direction),s=Es.dot(Es)-n*n,r=t.radius*t.radius;if(s>r)return null;let o=Math.sqrt(r-s),a=n-o,l=n+o;return l<0?null:a<0?this.at(l,e):this.at(a,e)}intersectsSphere(t){return t.radius<0?!1:this.distanceSqToPoint(t.center)<=t.radius*t.radius}distanceToPlane(t){let e=t.normal.dot(this.direction);if(e===0)return t.distanceToPoint(this.origin)===0?0:null;let n=-(this.origin.dot(t.normal)+t.constant)/e;return n>=0?n:null}intersectPlane(t,e){let n=this.distanceToPlane(t);return n===null?null:this.at(n,e)}intersectsPlane(t){let e=t.distanceToPoint(this.origin);return e===0||t.normal.dot(this.direction)*e<0}intersectBox(t,e){let n,s,r,o,a,l,c=1/this.direction.x,f=1/this.direction.y,u=1/this.direction.z,h=this.origin;return c>=0?(n=(t.min.x-h.x)*c,s=(t.max.x-h.x)*c):(n=(t.max.x-h.x)*c,s=(t.min.x-h.x)*c),f>=0?(r=(t.min.y-h.y)*f,o=(t.max.y-h.y)*f):(r=(t.max.y-h.y)*f,o=(t.min.y-h.y)*f),n>o||r>s||((r>n||isNaN(n))&&(n=r),(o<s||isNaN(s))&&(s=o),u>=0?(a=(t.min.z-h.z)*u,l=(t.max.z-h.z)*u):(a=(t.max.z-h.z)*u,l=(t.min.z-h.z)*u),n>l||a>s)||((a>n||n!==n)&&(n=a),(l<s||s!==s)&&(s=l),s<0)?null:this.at(n>=0?n:s,e)}intersectsBox(t){return this.intersectBox(t,Es)!==null}intersectTriangle(t,e,n,s,r){let o=this.origin,a=this.direction,l=a.x,c=a.y,f=a.z,u=t.x-o.x,h=t.y-o.y,d=t.z-o.z,g=e.x-o.x,v=e.y-o.y,m=e.z-o.z,p=n.x-o.x,_=n.y-o.y,M=n.z-o.z,y=Math.abs(l),w=Math.abs(c),T=Math.abs(f),x,b,D,C,P,I,O,L,z,X,H,at;if(y>=w&&y>=T?(D=l,I=u,z=g,at=p,l>=0?(x=c,b=f,C=h,P=d,O=v,L=m,X=_,H=M):(x=f,b=c,C=d,P=h,O=m,L=v,X=M,H=_)):w>=T?(D=c,I=h,z=v,at=_,c>=0?(x=f,b=l,C=d,P=u,O=m,L=g,X=M,H=p):(x=l,b=f,C=u,P=d,O=g,L=m,X=p,H=M)):(D=f,I=d,z=m,at=M,f>=0?(x=l,b=c,C=u,P=h,O=g,L=v,X=p,H=_):(x=c,b=l,C=h,P=u,O=v,L=g,X=_,H=p)),D===0)return null;let Z=x/D,j=b/D,nt=1/D,ut=C-Z*I,ht=P-j*I,Q=O-Z*z,dt=L-j*z,gt=X-Z*at,Et=H-j*at,St=gt*dt-Et*Q,Ht=ut*Et-ht*gt,ne=Q*ht-dt*ut;if(s){if(St<0||Ht<0||ne<0)return null}else if((St<0||Ht<0||ne<0)&&(St>0||Ht>0||ne>0))return null;let Vt=St+Ht+ne;if(Vt===0)return null;let le=nt*(St*I+Ht*z+ne*at);return(Vt>0?le<0:le>0)?null:this.at(le/Vt,r)}applyMatrix4(t){return this.origin.applyMatrix4(t),this.direction.transformDirection(t),this}equals(t){return t.origin.equals(this.origin)&&t.direction.equals(this.direction)}clone(){return new this.constructor().copy(this)}},ri=class extends Ls{constructor(t){super(),this.isMeshBasicMaterial=!0,this.type="MeshBasicMaterial",this.color=new $t(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new Ps,this.combine=hd,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.specularMap=t.specularMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.combine=t.combine,this.reflectivity=t.reflectivity,this.refractionRatio=t.refractionRatio,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.fog=t.fog,this}},ng=new te,Mr=new os,Jl=new Is,ig=new U,jl=new U,Ql=new U,tc=new U,qf=new U,ec=new U,sg=new U,nc=new U,En=class extends Wn{constructor(t=new pn,e=new ri){super(),this.isMesh=!0,this.type="Mesh",this.geometry=t,this.material=e,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.count=1,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),t.morphTargetInfluences!==void 0?this.morphTargetInfluences=t.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,t.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}updateMorphTargets(){let e=this.geometry.morphAttributes,n=Object.keys(e);if(n.length>0){let s=e[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}getVertexPosition(t,e){let n=this.geometry,s=n.attributes.position,r=n.morphAttributes.position,o=n.morphTargetsRelative;e.fromBufferAttribute(s,t);let a=this.morphTargetInfluences;if(r&&a){ec.set(0,0,0);for(let l=0,c=r.length;l<c;l++){let f=a[l],u=r[l];f!==0&&(qf.fromBufferAttribute(u,t),o?ec.addScaledVector(qf,f):ec.addScaledVector(qf.sub(e),f))}e.add(ec)}return e}intersectsFrustum(t){return t.intersectsObject(this)}raycast(t,e){let n=this.geometry,s=this.material,r=this.matrixWorld;s!==void 0&&(n.boundingSphere===null&&n.computeBoundingSphere(),Jl.copy(n.boundingSphere),Jl.applyMatrix4(r),Mr.copy(t.ray).recast(t.near),!(Jl.containsPoint(Mr.origin)===!1&&(Mr.intersectSphere(Jl,ig)===null||Mr.origin.distanceToSquared(ig)>(t.far-t.near)**2))&&(ng.copy(r).invert(),Mr.copy(t.ray).applyMatrix4(ng),!(n.boundingBox!==null&&Mr.intersectsBox(n.boundingBox)===!1)&&this._computeIntersections(t,e,Mr)))}_computeIntersections(t,e,n){let s,r=this.geometry,o=this.material,a=r.index,l=r.attributes.position,c=r.attributes.uv,f=r.attributes.uv1,u=r.attributes.normal,h=r.groups,d=r.drawRange;if(a!==null)if(Array.isArray(o))for(let g=0,v=h.length;g<v;g++){let m=h[g],p=o[m.materialIndex],_=Math.max(m.start,d.start),M=Math.min(a.count,Math.min(m.start+m.count,d.start+d.count));for(let y=_,w=M;y<w;y+=3){let T=a.getX(y),x=a.getX(y+1),b=a.getX(y+2);s=ic(this,p,t,n,c,f,u,T,x,b),s&&(s.faceIndex=Math.floor(y/3),s.face.materialIndex=m.materialIndex,e.push(s))}}else{let g=Math.max(0,d.start),v=Math.min(a.count,d.start+d.count);for(let m=g,p=v;m<p;m+=3){let _=a.getX(m),M=a.getX(m+1),y=a.getX(m+2);s=ic(this,o,t,n,c,f,u,_,M,y),s&&(s.faceIndex=Math.floor(m/3),e.push(s))}}else if(l!==void 0)if(Array.isArray(o))for(let g=0,v=h.length;g<v;g++){let m=h[g],p=o[m.materialIndex],_=Math.max(m.start,d.start),M=Math.min(l.count,Math.min(m.start+m.count,d.start+d.count));for(let y=_,w=M;y<w;y+=3){let T=y,x=y+1,b=y+2;s=ic(this,p,t,n,c,f,u,T,x,b),s&&(s.faceIndex=Math.floor(y/3),s.face.materialIndex=m.materialIndex,e.push(s))}}else{let g=Math.max(0,d.start),v=Math.min(l.count,d.start+d.count);for(let m=g,p=v;m<p;m+=3){let _=m,M=m+1,y=m+2;s=ic(this,o,t,n,c,f,u,_,M,y),s&&(s.faceIndex=Math.floor(m/3),e.push(s))}}}};function Lv(i,t,e,n,s,r,o,a){let l;if(t.side===Cn?l=n.intersectTriangle(o,r,s,!0,a):l=n.intersectTriangle(s,r,o,t.side===Mi,a),l===null)return null;nc.copy(a),nc.applyMatrix4(i.matrixWorld);let c=e.ray.origin.distanceTo(nc);return c<e.near||c>e.far?null:{distance:c,point:nc.clone(),object:i}}function ic(i,t,e,n,s,r,o,a,l,c){i.getVertexPosition(a,jl),i.getVertexPosition(l,Ql),i.getVertexPosition(c,tc);let f=Lv(i,t,e,n,jl,Ql,tc,sg);if(f){let u=new U;kn.getBarycoord(sg,jl,Ql,tc,u),s&&(f.uv=kn.getInterpolatedAttribute(s,a,l,c,u,new kt)),r&&(f.uv1=kn.getInterpolatedAttribute(r,a,l,c,u,new kt)),o&&(f.normal=kn.getInterpolatedAttribute(o,a,l,c,u,new U),f.normal.dot(n.direction)>0&&f.normal.multiplyScalar(-1));let h={a,b:l,c,normal:new U,materialIndex:0};kn.getNormal(jl,Ql,tc,h.normal),f.face=h,f.barycoord=u}return f}var wr=class extends ci{constructor(t=null,e=1,n=1,s,r,o,a,l,c=Vn,f=Vn,u,h){super(null,o,a,l,c,f,s,r,u,h),this.isDataTexture=!0,this.image={data:t,width:e,height:n},this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}};var Va=class extends Je{constructor(t,e,n,s=1){super(t,e,n),this.isInstancedBufferAttribute=!0,this.meshPerAttribute=s}copy(t){return super.copy(t),this.meshPerAttribute=t.meshPerAttribute,this}toJSON(){let t=super.toJSON();return t.meshPerAttribute=this.meshPerAttribute,t.isInstancedBufferAttribute=!0,t}},fo=new te,rg=new te,sc=[],og=new Oe,Dv=new te,Ea=new En,Ca=new Is,Ga=class extends En{constructor(t,e,n){super(t,e),this.isInstancedMesh=!0,this.instanceMatrix=new Va(new Float32Array(n*16),16),this.instanceColor=null,this.morphTexture=null,this.count=n,this.boundingBox=null,this.boundingSphere=null;for(let s=0;s<n;s++)this.setMatrixAt(s,Dv)}computeBoundingBox(){let t=this.geometry,e=this.count;this.boundingBox===null&&(this.boundingBox=new Oe),t.boundingBox===null&&t.computeBoundingBox(),this.boundingBox.makeEmpty();for(let n=0;n<e;n++)this.getMatrixAt(n,fo),og.copy(t.boundingBox).applyMatrix4(fo),this.boundingBox.union(og)}computeBoundingSphere(){let t=this.geometry,e=this.count;this.boundingSphere===null&&(this.boundingSphere=new Is),t.boundingSphere===null&&t.computeBoundingSphere(),this.boundingSphere.makeEmpty();for(let n=0;n<e;n++)this.getMatrixAt(n,fo),Ca.copy(t.boundingSphere).applyMatrix4(fo),this.boundingSphere.union(Ca)}copy(t,e){return super.copy(t,e),this.instanceMatrix.copy(t.instanceMatrix),this.morphTexture=t.morphTexture!==null?t.morphTexture.clone():null,this.instanceColor=t.instanceColor!==null?t.instanceColor.clone():null,this.count=t.count,this.boundingBox=t.boundingBox!==null?t.boundingBox.clone():null,this.boundingSphere=t.boundingSphere!==null?t.boundingSphere.clone():null,this}getColorAt(t,e){return this.instanceColor===null?e.setRGB(1,1,1):e.fromArray(this.instanceColor.array,t*3)}getMatrixAt(t,e){return e.fromArray(this.instanceMatrix.array,t*16)}getMorphAt(t,e){let n=e.morphTargetInfluences,s=this.morphTexture.source.data.data,r=n.length+1,o=t*r+1;for(let a=0;a<n.length;a++)n[a]=s[o+a]}raycast(t,e){let n=this.matrixWorld,s=this.count;if(Ea.geometry=this.geometry,Ea.material=this.material,Ea.material!==void 0&&(this.boundingSphere===null&&this.computeBoundingSphere(),Ca.copy(this.boundingSphere),Ca.applyMatrix4(n),t.ray.intersectsSphere(Ca)!==!1))for(let r=0;r<s;r++){this.getMatrixAt(r,fo),rg.multiplyMatrices(n,fo),Ea.matrixWorld=rg,Ea.raycast(t,sc);for(let o=0,a=sc.length;o<a;o++){let l=sc[o];l.instanceId=r,l.object=this,e.push(l)}sc.length=0}}setColorAt(t,e){return this.instanceColor===null&&(this.instanceColor=new Va(new Float32Array(this.instanceMatrix.count*3).fill(1),3)),e.toArray(this.instanceColor.array,t*3),this}setMatrixAt(t,e){return e.toArray(this.instanceMatrix.array,t*16),this}setMorphAt(t,e){let n=e.morphTargetInfluences,s=n.length+1;this.morphTexture===null&&(this.morphTexture=new wr(new Float32Array(s*this.count),s,this.count,Fo,ui));let r=this.morphTexture.source.data.data,o=0;for(let c=0;c<n.length;c++)o+=n[c];let a=this.geometry.morphTargetsRelative?1:1-o,l=s*t;return r[l]=a,r.set(n,l+1),this}updateMorphTargets(){}dispose(){super.dispose(),this.instanceMatrix.dispose(),this.instanceColor!==null&&this.instanceColor.dispose(),this.morphTexture!==null&&(this.morphTexture.dispose(),this.morphTexture=null)}},br=new Is,Nv=new kt(.5,.5),rc=new U,js=class{constructor(t=new An,e=new An,n=new An,s=new An,r=new An,o=new An){this.planes=[t,e,n,s,r,o]}set(t,e,n,s,r,o){let a=this.planes;return a[0].copy(t),a[1].copy(e),a[2].copy(n),a[3].copy(s),a[4].copy(r),a[5].copy(o),this}copy(t){let e=this.planes;for(let n=0;n<6;n++)e[n].copy(t.planes[n]);return this}setFromProjectionMatrix(t,e=Ii,n=!1){let s=this.planes,r=t.elements,o=r[0],a=r[1],l=r[2],c=r[3],f=r[4],u=r[5],h=r[6],d=r[7],g=r[8],v=r[9],m=r[10],p=r[11],_=r[12],M=r[13],y=r[14],w=r[15];if(s[0].setComponents(c-o,d-f,p-g,w-_).normalize(),s[1].setComponents(c+o,d+f,p+g,w+_).normalize(),s[2].setComponents(c+a,d+u,p+v,w+M).normalize(),s[3].setComponents(c-a,d-u,p-v,w-M).normalize(),n)s[4].setComponents(l,h,m,y).normalize(),s[5].setComponents(c-l,d-h,p-m,w-y).normalize();else if(s[4].setComponents(c-l,d-h,p-m,w-y).normalize(),e===Ii)s[5].setComponents(c+l,d+h,p+m,w+y).normalize();else if(e===So)s[5].setComponents(l,h,m,y).normalize();else throw new Error("THREE.Frustum.setFromProjectionMatrix(): Invalid coordinate system: "+e);return this}intersectsObject(t){if(t.boundingSphere!==void 0)t.boundingSphere===null&&t.computeBoundingSphere(),br.copy(t.boundingSphere).applyMatrix4(t.matrixWorld);else{let e=t.geometry;e.boundingSphere===null&&e.computeBoundingSphere(),br.copy(e.boundingSphere).applyMatrix4(t.matrixWorld)}return this.intersectsSphere(br)}intersectsSprite(t){br.center.set(0,0,0);let e=Nv.distanceTo(t.center);return br.radius=.7071067811865476+e,br.applyMatrix4(t.matrixWorld),this.intersectsSphere(br)}intersectsSphere(t){let e=this.planes,n=t.center,s=-t.radius;for(let r=0;r<6;r++)if(e[r].distanceToPoint(n)<s)return!1;return!0}intersectsBox(t){let e=this.planes;for(let n=0;n<6;n++){let s=e[n];if(rc.x=s.normal.x>0?t.max.x:t.min.x,rc.y=s.normal.y>0?t.max.y:t.min.y,rc.z=s.normal.z>0?t.max.z:t.min.z,s.distanceToPoint(rc)<0)return!1}return!0}containsPoint(t){let e=this.planes;for(let n=0;n<6;n++)if(e[n].distanceToPoint(t)<0)return!1;return!0}clone(){return new this.constructor().copy(this)}},ag=new te,Ac=class i{constructor(){this.coordinateSystem=Ii,this._frustums=[],this._count=0}setFromArrayCamera(t){let e=t.cameras,n=this._frustums;for(let s=0;s<e.length;s++){let r=e[s];ag.multiplyMatrices(r.projectionMatrix,r.matrixWorldInverse),n[s]===void 0&&(n[s]=new js),n[s].setFromProjectionMatrix(ag,r.coordinateSystem,r.reversedDepth)}return this._count=e.length,this}getFrustum(t){return this._frustums[t]}intersectsObject(t){let e=this._frustums;for(let n=0;n<this._count;n++)if(e[n].intersectsObject(t))return!0;return!1}intersectsSprite(t){let e=this._frustums;for(let n=0;n<this._count;n++)if(e[n].intersectsSprite(t))return!0;return!1}intersectsSphere(t){let e=this._frustums;for(let n=0;n<this._count;n++)if(e[n].intersectsSphere(t))return!0;return!1}intersectsBox(t){let e=this._frustums;for(let n=0;n<this._count;n++)if(e[n].intersectsBox(t))return!0;return!1}containsPoint(t){let e=this._frustums;for(let n=0;n<this._count;n++)if(e[n].containsPoint(t))return!0;return!1}copy(t){this.coordinateSystem=t.coordinateSystem;let e=this._frustums,n=t._frustums;for(let s=0;s<t._count;s++)e[s]===void 0&&(e[s]=new js),e[s].copy(n[s]);return this._count=t._count,this}clone(){return new i().copy(this)}};var as=class extends Ls{constructor(t){super(),this.isLineBasicMaterial=!0,this.type="LineBasicMaterial",this.color=new $t(16777215),this.map=null,this.linewidth=1,this.linecap="round",this.linejoin="round",this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.linewidth=t.linewidth,this.linecap=t.linecap,this.linejoin=t.linejoin,this.fog=t.fog,this}},Ec=new U,Cc=new U,lg=new te,Ra=new os,oc=new Is,Yf=new U,cg=new U,Eo=class extends Wn{constructor(t=new pn,e=new as){super(),this.isLine=!0,this.type="Line",this.geometry=t,this.material=e,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),t.morphTargetInfluences!==void 0?this.morphTargetInfluences=t.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,t.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}computeLineDistances(){let t=this.geometry;if(t.index===null){let e=t.attributes.position,n=[0];for(let s=1,r=e.count;s<r;s++)Ec.fromBufferAttribute(e,s-1),Cc.fromBufferAttribute(e,s),n[s]=n[s-1],n[s]+=Ec.distanceTo(Cc);t.setAttribute("lineDistance",new Xe(n,1))}else Yt("Line.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}intersectsFrustum(t){return t.intersectsObject(this)}raycast(t,e){let n=this.geometry,s=this.matrixWorld,r=t.params.Line.threshold,o=n.drawRange;if(n.boundingSphere===null&&n.computeBoundingSphere(),oc.copy(n.boundingSphere),oc.applyMatrix4(s),oc.radius+=r,t.ray.intersectsSphere(oc)===!1)return;lg.copy(s).invert(),Ra.copy(t.ray).applyMatrix4(lg);let a=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=a*a,c=this.isLineSegments?2:1,f=n.index,h=n.attributes.position;if(f!==null){let d=Math.max(0,o.start),g=Math.min(f.count,o.start+o.count);for(let v=d,m=g-1;v<m;v+=c){let p=f.getX(v),_=f.getX(v+1),M=ac(this,t,Ra,l,p,_,v);M&&e.push(M)}if(this.isLineLoop){let v=f.getX(g-1),m=f.getX(d),p=ac(this,t,Ra,l,v,m,g-1);p&&e.push(p)}}else{let d=Math.max(0,o.start),g=Math.min(h.count,o.start+o.count);for(let v=d,m=g-1;v<m;v+=c){let p=ac(this,t,Ra,l,v,v+1,v);p&&e.push(p)}if(this.isLineLoop){let v=ac(this,t,Ra,l,g-1,d,g-1);v&&e.push(v)}}}updateMorphTargets(){let e=this.geometry.morphAttributes,n=Object.keys(e);if(n.length>0){let s=e[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}};function ac(i,t,e,n,s,r,o){let a=i.geometry.attributes.position;if(Ec.fromBufferAttribute(a,s),Cc.fromBufferAttribute(a,r),e.distanceSqToSegment(Ec,Cc,Yf,cg)>n)return;Yf.applyMatrix4(i.matrixWorld);let c=t.ray.origin.distanceTo(Yf);if(!(c<t.near||c>t.far))return{distance:c,point:cg.clone().applyMatrix4(i.matrixWorld),index:o,face:null,faceIndex:null,barycoord:null,object:i}}var hg=new U,ug=new U,Tr=class extends Eo{constructor(t,e){super(t,e),this.isLineSegments=!0,this.type="LineSegments"}computeLineDistances(){let t=this.geometry;if(t.index===null){let e=t.attributes.position,n=[];for(let s=0,r=e.count;s<r;s+=2)hg.fromBufferAttribute(e,s),ug.fromBufferAttribute(e,s+1),n[s]=s===0?0:n[s-1],n[s+1]=n[s]+hg.distanceTo(ug);t.setAttribute("lineDistance",new Xe(n,1))}else Yt("LineSegments.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}};var Ha=class extends ci{constructor(t=[],e=Rr,n,s,r,o,a,l,c,f){super(t,e,n,s,r,o,a,l,c,f),this.isCubeTexture=!0,this.flipY=!1}get images(){return this.image}set images(t){this.image=t}};var Ds=class extends ci{constructor(t,e,n=Hi,s,r,o,a=Vn,l=Vn,c,f=Rs,u=1){if(f!==Rs&&f!==Us)throw new Error("THREE.DepthTexture: format must be either THREE.DepthFormat or THREE.DepthStencilFormat");let h={width:t,height:e,depth:u};super(h,s,r,o,a,l,f,n,c),this.isDepthTexture=!0,this.flipY=!1,this.generateMipmaps=!1,this.compareFunction=null}copy(t){return super.copy(t),this.source=new wo(Object.assign({},t.image)),this.compareFunction=t.compareFunction,this}toJSON(t){let e=super.toJSON(t);return e.compareFunction=this.compareFunction,e}},Wa=class extends Ds{constructor(t,e=Hi,n=Rr,s,r,o=Vn,a=Vn,l,c=Rs){let f={width:t,height:t,depth:1},u=[f,f,f,f,f,f];super(t,t,e,n,s,r,o,a,l,c),this.image=u,this.isCubeDepthTexture=!0,this.isCubeTexture=!0}get images(){return this.image}set images(t){this.image=t}},Xa=class extends ci{constructor(t=null){super(),this.sourceTexture=t,this.isExternalTexture=!0}copy(t){return super.copy(t),this.sourceTexture=t.sourceTexture,this}},Co=class i extends pn{constructor(t=1,e=1,n=1,s=1,r=1,o=1){super(),this.type="BoxGeometry",this.parameters={width:t,height:e,depth:n,widthSegments:s,heightSegments:r,depthSegments:o};let a=this;s=Math.floor(s),r=Math.floor(r),o=Math.floor(o);let l=[],c=[],f=[],u=[],h=0,d=0;g("z","y","x",-1,-1,n,e,t,o,r,0),g("z","y","x",1,-1,n,e,-t,o,r,1),g("x","z","y",1,1,t,n,e,s,o,2),g("x","z","y",1,-1,t,n,-e,s,o,3),g("x","y","z",1,-1,t,e,n,s,r,4),g("x","y","z",-1,-1,t,e,-n,s,r,5),this.setIndex(l),this.setAttribute("position",new Xe(c,3)),this.setAttribute("normal",new Xe(f,3)),this.setAttribute("uv",new Xe(u,2));function g(v,m,p,_,M,y,w,T,x,b,D){let C=y/x,P=w/b,I=y/2,O=w/2,L=T/2,z=x+1,X=b+1,H=0,at=0,Z=new U;for(let j=0;j<X;j++){let nt=j*P-O;for(let ut=0;ut<z;ut++){let ht=ut*C-I;Z[v]=ht*_,Z[m]=nt*M,Z[p]=L,c.push(Z.x,Z.y,Z.z),Z[v]=0,Z[m]=0,Z[p]=T>0?1:-1,f.push(Z.x,Z.y,Z.z),u.push(ut/x),u.push(1-j/b),H+=1}}for(let j=0;j<b;j++)for(let nt=0;nt<x;nt++){let ut=h+nt+z*j,ht=h+nt+z*(j+1),Q=h+(nt+1)+z*(j+1),dt=h+(nt+1)+z*j;l.push(ut,ht,dt),l.push(ht,Q,dt),at+=6}a.addGroup(d,at,D),d+=at,h+=H}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new i(t.width,t.height,t.depth,t.widthSegments,t.heightSegments,t.depthSegments)}};var Gi=class i extends pn{constructor(t=1,e=1,n=1,s=32,r=1,o=!1,a=0,l=Math.PI*2){super(),this.type="CylinderGeometry",this.parameters={radiusTop:t,radiusBottom:e,height:n,radialSegments:s,heightSegments:r,openEnded:o,thetaStart:a,thetaLength:l};let c=this;s=Math.floor(s),r=Math.floor(r);let f=[],u=[],h=[],d=[],g=0,v=[],m=n/2,p=0;_(),o===!1&&(t>0&&M(!0),e>0&&M(!1)),this.setIndex(f),this.setAttribute("position",new Xe(u,3)),this.setAttribute("normal",new Xe(h,3)),this.setAttribute("uv",new Xe(d,2));function _(){let y=new U,w=new U,T=0,x=(e-t)/n;for(let b=0;b<=r;b++){let D=[],C=b/r,P=C*(e-t)+t;for(let I=0;I<=s;I++){let O=I/s,L=O*l+a,z=Math.sin(L),X=Math.cos(L);w.x=P*z,w.y=-C*n+m,w.z=P*X,u.push(w.x,w.y,w.z),y.set(z,x,X).normalize(),h.push(y.x,y.y,y.z),d.push(O,1-C),D.push(g++)}v.push(D)}for(let b=0;b<s;b++)for(let D=0;D<r;D++){let C=v[D][b],P=v[D+1][b],I=v[D+1][b+1],O=v[D][b+1];(t>0||D!==0)&&(f.push(C,P,O),T+=3),(e>0||D!==r-1)&&(f.push(P,I,O),T+=3)}c.addGroup(p,T,0),p+=T}function M(y){let w=g,T=new kt,x=new U,b=0,D=y===!0?t:e,C=y===!0?1:-1;for(let I=1;I<=s;I++)u.push(0,m*C,0),h.push(0,C,0),d.push(.5,.5),g++;let P=g;for(let I=0;I<=s;I++){let L=I/s*l+a,z=Math.cos(L),X=Math.sin(L);x.x=D*X,x.y=m*C,x.z=D*z,u.push(x.x,x.y,x.z),h.push(0,C,0),T.x=z*.5+.5,T.y=X*.5*C+.5,d.push(T.x,T.y),g++}for(let I=0;I<s;I++){let O=w+I,L=P+I;y===!0?f.push(L,L+1,O):f.push(L+1,L,O),b+=3}c.addGroup(p,b,y===!0?1:2),p+=b}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new i(t.radiusTop,t.radiusBottom,t.height,t.radialSegments,t.heightSegments,t.openEnded,t.thetaStart,t.thetaLength)}},Qs=class i extends Gi{constructor(t=1,e=1,n=32,s=1,r=!1,o=0,a=Math.PI*2){super(0,t,e,n,s,r,o,a),this.type="ConeGeometry",this.parameters={radius:t,height:e,radialSegments:n,heightSegments:s,openEnded:r,thetaStart:o,thetaLength:a}}static fromJSON(t){return new i(t.radius,t.height,t.radialSegments,t.heightSegments,t.openEnded,t.thetaStart,t.thetaLength)}};var Ar=class i extends pn{constructor(t=1,e=1,n=1,s=1){super(),this.type="PlaneGeometry",this.parameters={width:t,height:e,widthSegments:n,heightSegments:s};let r=t/2,o=e/2,a=Math.floor(n),l=Math.floor(s),c=a+1,f=l+1,u=t/a,h=e/l,d=[],g=[],v=[],m=[];for(let p=0;p<f;p++){let _=p*h-o;for(let M=0;M<c;M++){let y=M*u-r;g.push(y,-_,0),v.push(0,0,1),m.push(M/a),m.push(1-p/l)}}for(let p=0;p<l;p++)for(let _=0;_<a;_++){let M=_+c*p,y=_+c*(p+1),w=_+1+c*(p+1),T=_+1+c*p;d.push(M,y,T),d.push(y,w,T)}this.setIndex(d),this.setAttribute("position",new Xe(g,3)),this.setAttribute("normal",new Xe(v,3)),this.setAttribute("uv",new Xe(m,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new i(t.width,t.height,t.widthSegments,t.heightSegments)}};var qa=class i extends pn{constructor(t=1,e=32,n=16,s=0,r=Math.PI*2,o=0,a=Math.PI){super(),this.type="SphereGeometry",this.parameters={radius:t,widthSegments:e,heightSegments:n,phiStart:s,phiLength:r,thetaStart:o,thetaLength:a},e=Math.max(3,Math.floor(e)),n=Math.max(2,Math.floor(n));let l=Math.min(o+a,Math.PI),c=0,f=[],u=new U,h=new U,d=[],g=[],v=[],m=[];for(let p=0;p<=n;p++){let _=[],M=p/n,y=o+M*a,w=t*Math.cos(y),T=Math.sqrt(t*t-w*w),x=0;p===0&&o===0?x=.5/e:p===n&&l===Math.PI&&(x=-.5/e);for(let b=0;b<=e;b++){let D=b/e,C=s+D*r;u.x=-T*Math.cos(C),u.y=w,u.z=T*Math.sin(C),g.push(u.x,u.y,u.z),h.copy(u).normalize(),v.push(h.x,h.y,h.z),m.push(D+x,1-M),_.push(c++)}f.push(_)}for(let p=0;p<n;p++)for(let _=0;_<e;_++){let M=f[p][_+1],y=f[p][_],w=f[p+1][_],T=f[p+1][_+1];(p!==0||o>0)&&d.push(M,y,T),(p!==n-1||l<Math.PI)&&d.push(y,w,T)}this.setIndex(d),this.setAttribute("position",new Xe(g,3)),this.setAttribute("normal",new Xe(v,3)),this.setAttribute("uv",new Xe(m,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new i(t.radius,t.widthSegments,t.heightSegments,t.phiStart,t.phiLength,t.thetaStart,t.thetaLength)}};var Ya=class i extends pn{constructor(t=1,e=.4,n=12,s=48,r=Math.PI*2,o=0,a=Math.PI*2){super(),this.type="TorusGeometry",this.parameters={radius:t,tube:e,radialSegments:n,tubularSegments:s,arc:r,thetaStart:o,thetaLength:a},n=Math.floor(n),s=Math.floor(s);let l=[],c=[],f=[],u=[],h=new U,d=new U,g=new U;for(let v=0;v<=n;v++){let m=o+v/n*a;for(let p=0;p<=s;p++){let _=p/s*r;d.x=(t+e*Math.cos(m))*Math.cos(_),d.y=(t+e*Math.cos(m))*Math.sin(_),d.z=e*Math.sin(m),c.push(d.x,d.y,d.z),h.x=t*Math.cos(_),h.y=t*Math.sin(_),g.subVectors(d,h).normalize(),f.push(g.x,g.y,g.z),u.push(p/s),u.push(v/n)}}for(let v=1;v<=n;v++)for(let m=1;m<=s;m++){let p=(s+1)*v+m-1,_=(s+1)*(v-1)+m-1,M=(s+1)*(v-1)+m,y=(s+1)*v+m;l.push(p,_,y),l.push(_,M,y)}this.setIndex(l),this.setAttribute("position",new Xe(c,3)),this.setAttribute("normal",new Xe(f,3)),this.setAttribute("uv",new Xe(u,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new i(t.radius,t.tube,t.radialSegments,t.tubularSegments,t.arc,t.thetaStart,t.thetaLength)}};function Ir(i){let t={};for(let e in i){t[e]={};for(let n in i[e]){let s=i[e][n];if(fg(s))s.isRenderTargetTexture?(Yt("UniformsUtils: Textures of render targets cannot be cloned via cloneUniforms() or mergeUniforms()."),t[e][n]=null):t[e][n]=s.clone();else if(Array.isArray(s))if(fg(s[0])){let r=[];for(let o=0,a=s.length;o<a;o++)r[o]=s[o].clone();t[e][n]=r}else t[e][n]=s.slice();else t[e][n]=s}}return t}function Kn(i){let t={};for(let e=0;e<i.length;e++){let n=Ir(i[e]);for(let s in n)t[s]=n[s]}return t}function fg(i){return i&&(i.isColor||i.isMatrix3||i.isMatrix4||i.isVector2||i.isVector3||i.isVector4||i.isTexture||i.isQuaternion)}function Uv(i){let t=[];for(let e=0;e<i.length;e++)t.push(i[e].clone());return t}function Od(i){let t=i.getRenderTarget();return t===null?i.outputColorSpace:t.isXRRenderTarget===!0?t.texture.colorSpace:xe.workingColorSpace}var a0={clone:Ir,merge:Kn},Fv=`void main() {
	gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
}`,Ov=`void main() {
	gl_FragColor = vec4( 1.0, 0.0, 0.0, 1.0 );
}`,ls=class extends Ls{constructor(t){super(),this.isShaderMaterial=!0,this.type="ShaderMaterial",this.defines={},this.uniforms={},this.uniformsGroups=[],this.vertexShader=Fv,this.fragmentShader=Ov,this.linewidth=1,this.wireframe=!1,this.wireframeLinewidth=1,this.fog=!1,this.lights=!1,this.clipping=!1,this.forceSinglePass=!0,this.extensions={clipCullDistance:!1,multiDraw:!1},this.defaultAttributeValues={color:[1,1,1],uv:[0,0],uv1:[0,0]},this.index0AttributeName=void 0,this.uniformsNeedUpdate=!1,this.glslVersion=null,t!==void 0&&this.setValues(t)}copy(t){return super.copy(t),this.fragmentShader=t.fragmentShader,this.vertexShader=t.vertexShader,this.uniforms=Ir(t.uniforms),this.uniformsGroups=Uv(t.uniformsGroups),this.defines=Object.assign({},t.defines),this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.fog=t.fog,this.lights=t.lights,this.clipping=t.clipping,this.extensions=Object.assign({},t.extensions),this.glslVersion=t.glslVersion,this.defaultAttributeValues=Object.assign({},t.defaultAttributeValues),this.index0AttributeName=t.index0AttributeName,this.uniformsNeedUpdate=t.uniformsNeedUpdate,this}toJSON(t){let e=super.toJSON(t);e.glslVersion=this.glslVersion,e.uniforms={};for(let s in this.uniforms){let o=this.uniforms[s].value;o&&o.isTexture?e.uniforms[s]={type:"t",value:o.toJSON(t).uuid}:o&&o.isColor?e.uniforms[s]={type:"c",value:o.getHex()}:o&&o.isVector2?e.uniforms[s]={type:"v2",value:o.toArray()}:o&&o.isVector3?e.uniforms[s]={type:"v3",value:o.toArray()}:o&&o.isVector4?e.uniforms[s]={type:"v4",value:o.toArray()}:o&&o.isMatrix3?e.uniforms[s]={type:"m3",value:o.toArray()}:o&&o.isMatrix4?e.uniforms[s]={type:"m4",value:o.toArray()}:e.uniforms[s]={value:o}}Object.keys(this.defines).length>0&&(e.defines=this.defines),e.vertexShader=this.vertexShader,e.fragmentShader=this.fragmentShader,e.lights=this.lights,e.clipping=this.clipping;let n={};for(let s in this.extensions)this.extensions[s]===!0&&(n[s]=!0);return Object.keys(n).length>0&&(e.extensions=n),e}fromJSON(t,e){if(super.fromJSON(t,e),t.uniforms!==void 0)for(let n in t.uniforms){let s=t.uniforms[n];switch(this.uniforms[n]={},s.type){case"t":this.uniforms[n].value=e[s.value]||null;break;case"c":this.uniforms[n].value=new $t().setHex(s.value);break;case"v2":this.uniforms[n].value=new kt().fromArray(s.value);break;case"v3":this.uniforms[n].value=new U().fromArray(s.value);break;case"v4":this.uniforms[n].value=new nn().fromArray(s.value);break;case"m3":this.uniforms[n].value=new ie().fromArray(s.value);break;case"m4":this.uniforms[n].value=new te().fromArray(s.value);break;default:this.uniforms[n].value=s.value}}if(t.defines!==void 0&&(this.defines=t.defines),t.vertexShader!==void 0&&(this.vertexShader=t.vertexShader),t.fragmentShader!==void 0&&(this.fragmentShader=t.fragmentShader),t.glslVersion!==void 0&&(this.glslVersion=t.glslVersion),t.extensions!==void 0)for(let n in t.extensions)this.extensions[n]=t.extensions[n];return t.lights!==void 0&&(this.lights=t.lights),t.clipping!==void 0&&(this.clipping=t.clipping),this}},Rc=class extends ls{constructor(t){super(t),this.isRawShaderMaterial=!0,this.type="RawShaderMaterial"}},cs=class extends Ls{constructor(t){super(),this.isMeshStandardMaterial=!0,this.type="MeshStandardMaterial",this.defines={STANDARD:""},this.color=new $t(16777215),this.roughness=1,this.metalness=0,this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.emissive=new $t(0),this.emissiveIntensity=1,this.emissiveMap=null,this.bumpMap=null,this.bumpScale=1,this.normalMap=null,this.normalMapType=Ph,this.normalScale=new kt(1,1),this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.roughnessMap=null,this.metalnessMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new Ps,this.envMapIntensity=1,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.flatShading=!1,this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.defines={STANDARD:""},this.color.copy(t.color),this.roughness=t.roughness,this.metalness=t.metalness,this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.emissive.copy(t.emissive),this.emissiveMap=t.emissiveMap,this.emissiveIntensity=t.emissiveIntensity,this.bumpMap=t.bumpMap,this.bumpScale=t.bumpScale,this.normalMap=t.normalMap,this.normalMapType=t.normalMapType,this.normalScale.copy(t.normalScale),this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.roughnessMap=t.roughnessMap,this.metalnessMap=t.metalnessMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.envMapIntensity=t.envMapIntensity,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.flatShading=t.flatShading,this.fog=t.fog,this}};var Pc=class extends Ls{constructor(t){super(),this.isMeshDepthMaterial=!0,this.type="MeshDepthMaterial",this.depthPacking=qg,this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.wireframe=!1,this.wireframeLinewidth=1,this.setValues(t)}copy(t){return super.copy(t),this.depthPacking=t.depthPacking,this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this}},Ic=class extends Ls{constructor(t){super(),this.isMeshDistanceMaterial=!0,this.type="MeshDistanceMaterial",this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.setValues(t)}copy(t){return super.copy(t),this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this}};function po(i,t){return!i||i.constructor===t?i:typeof t.BYTES_PER_ELEMENT=="number"?new t(i):Array.prototype.slice.call(i)}function lc(i){return i!==void 0&&i.inTangents!==void 0&&i.outTangents!==void 0}var tr=class{constructor(t,e,n,s){this.parameterPositions=t,this._cachedIndex=0,this.resultBuffer=s!==void 0?s:new e.constructor(n),this.sampleValues=e,this.valueSize=n,this.settings=null,this.DefaultSettings_={}}evaluate(t){let e=this.parameterPositions,n=this._cachedIndex,s=e[n],r=e[n-1];n:{t:{let o;e:{i:if(!(t<s)){for(let a=n+2;;){if(s===void 0){if(t<r)break i;return n=e.length,this._cachedIndex=n,this.copySampleValue_(n-1)}if(n===a)break;if(r=s,s=e[++n],t<s)break t}o=e.length;break e}if(!(t>=r)){let a=e[1];t<a&&(n=2,r=a);for(let l=n-2;;){if(r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(n===l)break;if(s=r,r=e[--n-1],t>=r)break t}o=n,n=0;break e}break n}for(;n<o;){let a=n+o>>>1;t<e[a]?o=a:n=a+1}if(s=e[n],r=e[n-1],r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(s===void 0)return n=e.length,this._cachedIndex=n,this.copySampleValue_(n-1)}this._cachedIndex=n,this.intervalChanged_(n,r,s)}return this.interpolate_(n,r,t,s)}getSettings_(){return this.settings||this.DefaultSettings_}copySampleValue_(t){let e=this.resultBuffer,n=this.sampleValues,s=this.valueSize,r=t*s;for(let o=0;o!==s;++o)e[o]=n[r+o];return e}interpolate_(){throw new Error("THREE.Interpolant: Call to abstract method.")}intervalChanged_(){}},Lc=class extends tr{constructor(t,e,n,s){super(t,e,n,s),this._weightPrev=-0,this._offsetPrev=-0,this._weightNext=-0,this._offsetNext=-0,this.DefaultSettings_={endingStart:Jf,endingEnd:Jf}}intervalChanged_(t,e,n){let s=this.parameterPositions,r=t-2,o=t+1,a=s[r],l=s[o];if(a===void 0)switch(this.getSettings_().endingStart){case jf:r=t,a=2*e-n;break;case Qf:r=s.length-2,a=e+s[r]-s[r+1];break;default:r=t,a=n}if(l===void 0)switch(this.getSettings_().endingEnd){case jf:o=t,l=2*n-e;break;case Qf:o=1,l=n+s[1]-s[0];break;default:o=t-1,l=e}let c=(n-e)*.5,f=this.valueSize;this._weightPrev=c/(e-a),this._weightNext=c/(l-n),this._offsetPrev=r*f,this._offsetNext=o*f}interpolate_(t,e,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=t*a,c=l-a,f=this._offsetPrev,u=this._offsetNext,h=this._weightPrev,d=this._weightNext,g=(n-e)/(s-e),v=g*g,m=v*g,p=-h*m+2*h*v-h*g,_=(1+h)*m+(-1.5-2*h)*v+(-.5+h)*g+1,M=(-1-d)*m+(1.5+d)*v+.5*g,y=d*m-d*v;for(let w=0;w!==a;++w)r[w]=p*o[f+w]+_*o[c+w]+M*o[l+w]+y*o[u+w];return r}},Dc=class extends tr{constructor(t,e,n,s){super(t,e,n,s)}interpolate_(t,e,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=t*a,c=l-a,f=(n-e)/(s-e),u=1-f;for(let h=0;h!==a;++h)r[h]=o[c+h]*u+o[l+h]*f;return r}},Nc=class extends tr{constructor(t,e,n,s){super(t,e,n,s)}interpolate_(t){return this.copySampleValue_(t-1)}},Uc=class extends tr{interpolate_(t,e,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=t*a,c=l-a,f=this.inTangents,u=this.outTangents;if(!f||!u){let g=(n-e)/(s-e),v=1-g;for(let m=0;m!==a;++m)r[m]=o[c+m]*v+o[l+m]*g;return r}let h=a*2,d=t-1;for(let g=0;g!==a;++g){let v=o[c+g],m=o[l+g],p=d*h+g*2,_=u[p],M=u[p+1],y=t*h+g*2,w=f[y],T=f[y+1],x=zv(n,e,_,w,s);r[g]=l0(x,v,M,T,m)}return r}};function l0(i,t,e,n,s){let r=1-i;return r*r*r*t+3*r*r*i*e+3*r*i*i*n+i*i*i*s}function Bv(i,t,e,n,s){let r=1-i;return 3*r*r*(e-t)+6*r*i*(n-e)+3*i*i*(s-n)}function zv(i,t,e,n,s){let r=(i-t)/(s-t);for(let o=0;o<8;o++){let a=l0(r,t,e,n,s)-i;if(Math.abs(a)<1e-10)break;let l=Bv(r,t,e,n,s);if(Math.abs(l)<1e-10)break;r=Math.max(0,Math.min(1,r-a/l))}return r}var Si=class{constructor(t,e,n,s){if(t===void 0)throw new Error("THREE.KeyframeTrack: track name is undefined");if(e===void 0||e.length===0)throw new Error("THREE.KeyframeTrack: no keyframes in track named "+t);this.name=t,this.times=po(e,this.TimeBufferType),this.values=po(n,this.ValueBufferType),this.setInterpolation(s||this.DefaultInterpolation)}static toJSON(t){let e=t.constructor,n;if(e.toJSON!==this.toJSON)n=e.toJSON(t);else{n={name:t.name,times:po(t.times,Array),values:po(t.values,Array)};let s=t.getInterpolation();s!==t.DefaultInterpolation&&(n.interpolation=s),lc(t.settings)&&(n.settings={inTangents:po(t.settings.inTangents,Array),outTangents:po(t.settings.outTangents,Array)})}return n.type=t.ValueTypeName,n}InterpolantFactoryMethodDiscrete(t){return new Nc(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodLinear(t){return new Dc(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodSmooth(t){return new Lc(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodBezier(t){let e=new Uc(this.times,this.values,this.getValueSize(),t);return this.settings&&(e.inTangents=this.settings.inTangents,e.outTangents=this.settings.outTangents),e}setInterpolation(t){let e;switch(t){case Da:e=this.InterpolantFactoryMethodDiscrete;break;case Mc:e=this.InterpolantFactoryMethodLinear;break;case fc:e=this.InterpolantFactoryMethodSmooth;break;case Kf:e=this.InterpolantFactoryMethodBezier;break}if(e===void 0){let n="unsupported interpolation for "+this.ValueTypeName+" keyframe track named "+this.name;if(this.createInterpolant===void 0)if(t!==this.DefaultInterpolation)this.setInterpolation(this.DefaultInterpolation);else throw new Error(n);return Yt("KeyframeTrack:",n),this}return this.createInterpolant=e,this}getInterpolation(){switch(this.createInterpolant){case this.InterpolantFactoryMethodDiscrete:return Da;case this.InterpolantFactoryMethodLinear:return Mc;case this.InterpolantFactoryMethodSmooth:return fc;case this.InterpolantFactoryMethodBezier:return Kf}}getValueSize(){return this.values.length/this.times.length}shift(t){if(t!==0){let e=this.times;for(let n=0,s=e.length;n!==s;++n)e[n]+=t;lc(this.settings)&&(dg(this.settings.inTangents,t),dg(this.settings.outTangents,t))}return this}scale(t){if(t!==1){let e=this.times;for(let n=0,s=e.length;n!==s;++n)e[n]*=t;lc(this.settings)&&(pg(this.settings.inTangents,t),pg(this.settings.outTangents,t))}return this}trim(t,e){let n=this.times,s=n.length,r=0,o=s-1;for(;r!==s&&n[r]<t;)++r;for(;o!==-1&&n[o]>e;)--o;if(++o,r!==0||o!==s){r>=o&&(o=Math.max(o,1),r=o-1);let a=this.getValueSize();this.times=n.slice(r,o),this.values=this.values.slice(r*a,o*a)}return this}validate(){let t=!0,e=this.getValueSize();e-Math.floor(e)!==0&&(Qt("KeyframeTrack: Invalid value size in track.",this),t=!1);let n=this.times,s=this.values,r=n.length;r===0&&(Qt("KeyframeTrack: Track is empty.",this),t=!1);let o=null;for(let a=0;a!==r;a++){let l=n[a];if(typeof l=="number"&&isNaN(l)){Qt("KeyframeTrack: Time is not a valid number.",this,a,l),t=!1;break}if(o!==null&&o>l){Qt("KeyframeTrack: Out of order keys.",this,a,l,o),t=!1;break}o=l}if(s!==void 0&&tv(s))for(let a=0,l=s.length;a!==l;++a){let c=s[a];if(isNaN(c)){Qt("KeyframeTrack: Value is not a valid number.",this,a,c),t=!1;break}}return t}optimize(){let t=this.times.slice(),e=this.values.slice(),n=this.getValueSize(),s=this.getInterpolation()===fc,r=t.length-1,o=1;for(let a=1;a<r;++a){let l=!1,c=t[a],f=t[a+1];if(c!==f&&(a!==1||c!==t[0]))if(s)l=!0;else{let u=a*n,h=u-n,d=u+n;for(let g=0;g!==n;++g){let v=e[u+g];if(v!==e[h+g]||v!==e[d+g]){l=!0;break}}}if(l){if(a!==o){t[o]=t[a];let u=a*n,h=o*n;for(let d=0;d!==n;++d)e[h+d]=e[u+d]}++o}}if(r>0){t[o]=t[r];for(let a=r*n,l=o*n,c=0;c!==n;++c)e[l+c]=e[a+c];++o}return o!==t.length?(this.times=t.slice(0,o),this.values=e.slice(0,o*n)):(this.times=t,this.values=e),this}clone(){let t=this.times.slice(),e=this.values.slice(),n=this.constructor,s=new n(this.name,t,e);return s.createInterpolant=this.createInterpolant,lc(this.settings)&&(s.settings={inTangents:this.settings.inTangents.slice(),outTangents:this.settings.outTangents.slice()}),s}};function dg(i,t){for(let e=0,n=i.length;e!==n;e+=2)i[e]+=t}function pg(i,t){for(let e=0,n=i.length;e!==n;e+=2)i[e]*=t}Si.prototype.ValueTypeName="";Si.prototype.TimeBufferType=Float32Array;Si.prototype.ValueBufferType=Float32Array;Si.prototype.DefaultInterpolation=Mc;var er=class extends Si{constructor(t,e,n){super(t,e,n)}};er.prototype.ValueTypeName="bool";er.prototype.ValueBufferType=Array;er.prototype.DefaultInterpolation=Da;er.prototype.InterpolantFactoryMethodLinear=void 0;er.prototype.InterpolantFactoryMethodSmooth=void 0;var Fc=class extends Si{constructor(t,e,n,s){super(t,e,n,s)}};Fc.prototype.ValueTypeName="color";var Oc=class extends Si{constructor(t,e,n,s){super(t,e,n,s)}};Oc.prototype.ValueTypeName="number";var Bc=class extends tr{constructor(t,e,n,s){super(t,e,n,s)}interpolate_(t,e,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=(n-e)/(s-e),c=t*a;for(let f=c+a;c!==f;c+=4)en.slerpFlat(r,0,o,c-a,o,c,l);return r}},Za=class extends Si{constructor(t,e,n,s){super(t,e,n,s)}InterpolantFactoryMethodLinear(t){return new Bc(this.times,this.values,this.getValueSize(),t)}};Za.prototype.ValueTypeName="quaternion";Za.prototype.InterpolantFactoryMethodSmooth=void 0;var nr=class extends Si{constructor(t,e,n){super(t,e,n)}};nr.prototype.ValueTypeName="string";nr.prototype.ValueBufferType=Array;nr.prototype.DefaultInterpolation=Da;nr.prototype.InterpolantFactoryMethodLinear=void 0;nr.prototype.InterpolantFactoryMethodSmooth=void 0;var zc=class extends Si{constructor(t,e,n,s){super(t,e,n,s)}};zc.prototype.ValueTypeName="vector";var kc=class{constructor(t,e,n){let s=this,r=!1,o=0,a=0,l,c=[];this.onStart=void 0,this.onLoad=t,this.onProgress=e,this.onError=n,this._abortController=null,this.itemStart=function(f){a++,r===!1&&s.onStart!==void 0&&s.onStart(f,o,a),r=!0},this.itemEnd=function(f){o++,s.onProgress!==void 0&&s.onProgress(f,o,a),o===a&&(r=!1,s.onLoad!==void 0&&s.onLoad())},this.itemError=function(f){s.onError!==void 0&&s.onError(f)},this.resolveURL=function(f){return f=f.normalize("NFC"),l?l(f):f},this.setURLModifier=function(f){return l=f,this},this.addHandler=function(f,u){return c.push(f,u),this},this.removeHandler=function(f){let u=c.indexOf(f);return u!==-1&&c.splice(u,2),this},this.getHandler=function(f){for(let u=0,h=c.length;u<h;u+=2){let d=c[u],g=c[u+1];if(d.global&&(d.lastIndex=0),d.test(f))return g}return null},this.abort=function(){return this.abortController.abort(),this._abortController=null,this}}get abortController(){return this._abortController||(this._abortController=new AbortController),this._abortController}},c0=new kc,Vc=class{constructor(t){this.manager=t!==void 0?t:c0,this.crossOrigin="anonymous",this.withCredentials=!1,this.path="",this.resourcePath="",this.requestHeader={},this.priority="auto",this.cache="default",typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}load(){}loadAsync(t,e){let n=this;return new Promise(function(s,r){n.load(t,s,e,r)})}parse(){}setCrossOrigin(t){return this.crossOrigin=t,this}setWithCredentials(t){return this.withCredentials=t,this}setPath(t){return this.path=t,this}setResourcePath(t){return this.resourcePath=t,this}setRequestHeader(t){return this.requestHeader=t,this}setPriority(t){return this.priority=t,this}setCache(t){return this.cache=t,this}abort(){return this}};Vc.DEFAULT_MATERIAL_NAME="__DEFAULT";var $a=class extends Wn{static registerNode(t){this.prototype._lightNode=t}constructor(t,e=1){super(),this.isLight=!0,this.type="Light",this.color=new $t(t),this.intensity=e}copy(t,e){return super.copy(t,e),this.color.copy(t.color),this.intensity=t.intensity,this}toJSON(t){let e=super.toJSON(t);return e.object.color=this.color.getHex(),e.object.intensity=this.intensity,e}},Ka=class extends $a{constructor(t,e,n){super(t,n),this.isHemisphereLight=!0,this.type="HemisphereLight",this.position.copy(Wn.DEFAULT_UP),this.updateMatrix(),this.groundColor=new $t(e)}copy(t,e){return super.copy(t,e),this.groundColor.copy(t.groundColor),this}toJSON(t){let e=super.toJSON(t);return e.object.groundColor=this.groundColor.getHex(),e}},Zf=new te,mg=new U,gg=new U,Gc=class{constructor(t){this.camera=t,this.intensity=1,this.bias=0,this.biasNode=null,this.normalBias=0,this.radius=1,this.blurSamples=8,this.mapSize=new kt(512,512),this.mapType=hi,this.map=null,this.mapPass=null,this.matrix=new te,this.autoUpdate=!0,this.needsUpdate=!1,this._frustum=new js,this._frameExtents=new kt(1,1),this._viewportCount=1,this._viewports=[new nn(0,0,1,1)]}getViewportCount(){return this._viewportCount}getCamera(){return this.camera}getFrustum(){return this._frustum}updateMatrices(t){let e=this.camera;mg.setFromMatrixPosition(t.matrixWorld),e.position.copy(mg),gg.setFromMatrixPosition(t.target.matrixWorld),e.lookAt(gg),e.updateMatrixWorld(),this._updateMatrix(e,this.matrix,this._frustum)}_updateMatrix(t,e,n,s){Zf.multiplyMatrices(t.projectionMatrix,t.matrixWorldInverse),n.setFromProjectionMatrix(Zf,t.coordinateSystem,t.reversedDepth);let r=this._frameExtents,o=s?s.z/r.x:1,a=s?s.w/r.y:1,l=s?s.x/r.x:0,c=s?s.y/r.y:0;t.coordinateSystem===So||t.reversedDepth?e.set(.5*o,0,0,.5*o+l,0,.5*a,0,.5*a+c,0,0,1,0,0,0,0,1):e.set(.5*o,0,0,.5*o+l,0,.5*a,0,.5*a+c,0,0,.5,.5,0,0,0,1),e.multiply(Zf)}getViewport(t){return this._viewports[t]}getFrameExtents(){return this._frameExtents}dispose(){this.map&&this.map.dispose(),this.mapPass&&this.mapPass.dispose()}copy(t){return this.camera=t.camera.clone(),this.intensity=t.intensity,this.bias=t.bias,this.radius=t.radius,this.autoUpdate=t.autoUpdate,this.needsUpdate=t.needsUpdate,this.normalBias=t.normalBias,this.blurSamples=t.blurSamples,this.mapSize.copy(t.mapSize),this.mapType=t.mapType,this.biasNode=t.biasNode,this}clone(){return new this.constructor().copy(this)}toJSON(){let t={};return t.intensity=this.intensity,t.bias=this.bias,t.normalBias=this.normalBias,t.radius=this.radius,t.blurSamples=this.blurSamples,t.mapSize=this.mapSize.toArray(),t.mapType=this.mapType,t.camera=this.camera.toJSON(!1).object,delete t.camera.matrix,t}},cc=new U,hc=new en,ss=new U,Ja=class extends Wn{constructor(){super(),this.isCamera=!0,this.type="Camera",this.matrixWorldInverse=new te,this.projectionMatrix=new te,this.projectionMatrixInverse=new te,this.coordinateSystem=Ii,this._reversedDepth=!1}get reversedDepth(){return this._reversedDepth}copy(t,e){return super.copy(t,e),this.matrixWorldInverse.copy(t.matrixWorldInverse),this.projectionMatrix.copy(t.projectionMatrix),this.projectionMatrixInverse.copy(t.projectionMatrixInverse),this.coordinateSystem=t.coordinateSystem,this}getWorldDirection(t){return super.getWorldDirection(t).negate()}updateMatrixWorld(t){super.updateMatrixWorld(t),this.matrixWorld.decompose(cc,hc,ss),ss.x===1&&ss.y===1&&ss.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(cc,hc,ss.set(1,1,1)).invert()}updateWorldMatrix(t,e,n=!1){super.updateWorldMatrix(t,e,n),this.matrixWorld.decompose(cc,hc,ss),ss.x===1&&ss.y===1&&ss.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(cc,hc,ss.set(1,1,1)).invert()}clone(){return new this.constructor().copy(this)}},Ks=new U,_g=new kt,xg=new kt,ii=class extends Ja{constructor(t=50,e=1,n=.1,s=2e3){super(),this.isPerspectiveCamera=!0,this.type="PerspectiveCamera",this.fov=t,this.zoom=1,this.near=n,this.far=s,this.focus=10,this.aspect=e,this.view=null,this.filmGauge=35,this.filmOffset=0,this.updateProjectionMatrix()}copy(t,e){return super.copy(t,e),this.fov=t.fov,this.zoom=t.zoom,this.near=t.near,this.far=t.far,this.focus=t.focus,this.aspect=t.aspect,this.view=t.view===null?null:Object.assign({},t.view),this.filmGauge=t.filmGauge,this.filmOffset=t.filmOffset,this}setFocalLength(t){let e=.5*this.getFilmHeight()/t;this.fov=bo*2*Math.atan(e),this.updateProjectionMatrix()}getFocalLength(){let t=Math.tan(Ia*.5*this.fov);return .5*this.getFilmHeight()/t}getEffectiveFOV(){return bo*2*Math.atan(Math.tan(Ia*.5*this.fov)/this.zoom)}getFilmWidth(){return this.filmGauge*Math.min(this.aspect,1)}getFilmHeight(){return this.filmGauge/Math.max(this.aspect,1)}getViewBounds(t,e,n){Ks.set(-1,-1,.5).applyMatrix4(this.projectionMatrixInverse),e.set(Ks.x,Ks.y).multiplyScalar(-t/Ks.z),Ks.set(1,1,.5).applyMatrix4(this.projectionMatrixInverse),n.set(Ks.x,Ks.y).multiplyScalar(-t/Ks.z)}getViewSize(t,e){return this.getViewBounds(t,_g,xg),e.subVectors(xg,_g)}setViewOffset(t,e,n,s,r,o){this.aspect=t/e,this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=e,this.view.offsetX=n,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let t=this.near,e=t*Math.tan(Ia*.5*this.fov)/this.zoom,n=2*e,s=this.aspect*n,r=-.5*s,o=this.view;if(this.view!==null&&this.view.enabled){let l=o.fullWidth,c=o.fullHeight;r+=o.offsetX*s/l,e-=o.offsetY*n/c,s*=o.width/l,n*=o.height/c}let a=this.filmOffset;a!==0&&(r+=t*a/this.getFilmWidth()),this.projectionMatrix.makePerspective(r,r+s,e,e-n,t,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){let e=super.toJSON(t);return e.object.fov=this.fov,e.object.zoom=this.zoom,e.object.near=this.near,e.object.far=this.far,e.object.focus=this.focus,e.object.aspect=this.aspect,this.view!==null&&(e.object.view=Object.assign({},this.view)),e.object.filmGauge=this.filmGauge,e.object.filmOffset=this.filmOffset,e}};var ja=class extends Ja{constructor(t=-1,e=1,n=1,s=-1,r=.1,o=2e3){super(),this.isOrthographicCamera=!0,this.type="OrthographicCamera",this.zoom=1,this.view=null,this.left=t,this.right=e,this.top=n,this.bottom=s,this.near=r,this.far=o,this.updateProjectionMatrix()}copy(t,e){return super.copy(t,e),this.left=t.left,this.right=t.right,this.top=t.top,this.bottom=t.bottom,this.near=t.near,this.far=t.far,this.zoom=t.zoom,this.view=t.view===null?null:Object.assign({},t.view),this}setViewOffset(t,e,n,s,r,o){this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=e,this.view.offsetX=n,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let t=(this.right-this.left)/(2*this.zoom),e=(this.top-this.bottom)/(2*this.zoom),n=(this.right+this.left)/2,s=(this.top+this.bottom)/2,r=n-t,o=n+t,a=s+e,l=s-e;if(this.view!==null&&this.view.enabled){let c=(this.right-this.left)/this.view.fullWidth/this.zoom,f=(this.top-this.bottom)/this.view.fullHeight/this.zoom;r+=c*this.view.offsetX,o=r+c*this.view.width,a-=f*this.view.offsetY,l=a-f*this.view.height}this.projectionMatrix.makeOrthographic(r,o,a,l,this.near,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){let e=super.toJSON(t);return e.object.zoom=this.zoom,e.object.left=this.left,e.object.right=this.right,e.object.top=this.top,e.object.bottom=this.bottom,e.object.near=this.near,e.object.far=this.far,this.view!==null&&(e.object.view=Object.assign({},this.view)),e}},td=class extends Gc{constructor(){super(new ja(-5,5,5,-5,.5,500)),this.isDirectionalLightShadow=!0}},Ro=class extends $a{constructor(t,e){super(t,e),this.isDirectionalLight=!0,this.type="DirectionalLight",this.position.copy(Wn.DEFAULT_UP),this.updateMatrix(),this.target=new Wn,this.shadow=new td}dispose(){super.dispose(),this.shadow.dispose()}copy(t){return super.copy(t),this.target=t.target.clone(),this.shadow=t.shadow.clone(),this}toJSON(t){let e=super.toJSON(t);return e.object.shadow=this.shadow.toJSON(),e.object.target=this.target.uuid,e}};var mo=-90,go=1,Po=class extends Wn{constructor(t,e,n){super(),this.type="CubeCamera",this.renderTarget=n,this.coordinateSystem=null,this.activeMipmapLevel=0;let s=new ii(mo,go,t,e);s.layers=this.layers,this.add(s);let r=new ii(mo,go,t,e);r.layers=this.layers,this.add(r);let o=new ii(mo,go,t,e);o.layers=this.layers,this.add(o);let a=new ii(mo,go,t,e);a.layers=this.layers,this.add(a);let l=new ii(mo,go,t,e);l.layers=this.layers,this.add(l);let c=new ii(mo,go,t,e);c.layers=this.layers,this.add(c)}updateCoordinateSystem(){let t=this.coordinateSystem,e=this.children.concat(),[n,s,r,o,a,l]=e;for(let c of e)this.remove(c);if(t===Ii)n.up.set(0,1,0),n.lookAt(1,0,0),s.up.set(0,1,0),s.lookAt(-1,0,0),r.up.set(0,0,-1),r.lookAt(0,1,0),o.up.set(0,0,1),o.lookAt(0,-1,0),a.up.set(0,1,0),a.lookAt(0,0,1),l.up.set(0,1,0),l.lookAt(0,0,-1);else if(t===So)n.up.set(0,-1,0),n.lookAt(-1,0,0),s.up.set(0,-1,0),s.lookAt(1,0,0),r.up.set(0,0,1),r.lookAt(0,1,0),o.up.set(0,0,-1),o.lookAt(0,-1,0),a.up.set(0,-1,0),a.lookAt(0,0,1),l.up.set(0,-1,0),l.lookAt(0,0,-1);else throw new Error("THREE.CubeCamera.updateCoordinateSystem(): Invalid coordinate system: "+t);for(let c of e)this.add(c),c.updateMatrixWorld()}update(t,e){this.parent===null&&this.updateMatrixWorld();let{renderTarget:n,activeMipmapLevel:s}=this;this.coordinateSystem!==t.coordinateSystem&&(this.coordinateSystem=t.coordinateSystem,this.updateCoordinateSystem());let[r,o,a,l,c,f]=this.children,u=t.getRenderTarget(),h=t.getActiveCubeFace(),d=t.getActiveMipmapLevel(),g=t.xr.enabled;t.xr.enabled=!1;let v=n.texture.mipmapsAutoUpdate;n.texture.mipmapsAutoUpdate=!1;let m=!1;t.isWebGLRenderer===!0?m=t.state.buffers.depth.getReversed():m=t.reversedDepthBuffer,t.setRenderTarget(n,0,s),m&&t.autoClear===!1&&t.clearDepth(),t.render(e,r),t.setRenderTarget(n,1,s),m&&t.autoClear===!1&&t.clearDepth(),t.render(e,o),t.setRenderTarget(n,2,s),m&&t.autoClear===!1&&t.clearDepth(),t.render(e,a),t.setRenderTarget(n,3,s),m&&t.autoClear===!1&&t.clearDepth(),t.render(e,l),t.setRenderTarget(n,4,s),m&&t.autoClear===!1&&t.clearDepth(),t.render(e,c),n.texture.mipmapsAutoUpdate=v,t.setRenderTarget(n,5,s),m&&t.autoClear===!1&&t.clearDepth(),t.render(e,f),t.setRenderTarget(u,h,d),t.xr.enabled=g,n.texture.needsPMREMUpdate=!0}},Hc=class extends ii{constructor(t=[]){super(),this.isArrayCamera=!0,this.isMultiViewCamera=!1,this.cameras=t,this.perCameraFrustumCulled=!1}};var Bd="\\[\\]\\.:\\/",kv=new RegExp("["+Bd+"]","g"),zd="[^"+Bd+"]",Vv="[^"+Bd.replace("\\.","")+"]",Gv=/((?:WC+[\/:])*)/.source.replace("WC",zd),Hv=/(WCOD+)?/.source.replace("WCOD",Vv),Wv=/(?:\.(WC+)(?:\[(.+)\])?)?/.source.replace("WC",zd),Xv=/\.(WC+)(?:\[(.+)\])?/.source.replace("WC",zd),qv=new RegExp("^"+Gv+Hv+Wv+Xv+"$"),Yv=["material","materials","bones","map"],ed=class{constructor(t,e,n){let s=n||Ke.parseTrackName(e);this._targetGroup=t,this._bindings=t.subscribe_(e,s)}getValue(t,e){this.bind();let n=this._targetGroup.nCachedObjects_,s=this._bindings[n];s!==void 0&&s.getValue(t,e)}setValue(t,e){let n=this._bindings;for(let s=this._targetGroup.nCachedObjects_,r=n.length;s!==r;++s)n[s].setValue(t,e)}bind(){let t=this._bindings;for(let e=this._targetGroup.nCachedObjects_,n=t.length;e!==n;++e)t[e].bind()}unbind(){let t=this._bindings;for(let e=this._targetGroup.nCachedObjects_,n=t.length;e!==n;++e)t[e].unbind()}},Ke=class i{constructor(t,e,n){this.path=e,this.parsedPath=n||i.parseTrackName(e),this.node=i.findNode(t,this.parsedPath.nodeName),this.rootNode=t,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}static create(t,e,n){return t&&t.isAnimationObjectGroup?new i.Composite(t,e,n):new i(t,e,n)}static sanitizeNodeName(t){return t.replace(/\s/g,"_").replace(kv,"")}static parseTrackName(t){let e=qv.exec(t);if(e===null)throw new Error("THREE.PropertyBinding: Cannot parse trackName: "+t);let n={nodeName:e[2],objectName:e[3],objectIndex:e[4],propertyName:e[5],propertyIndex:e[6]},s=n.nodeName&&n.nodeName.lastIndexOf(".");if(s!==void 0&&s!==-1){let r=n.nodeName.substring(s+1);Yv.indexOf(r)!==-1&&(n.nodeName=n.nodeName.substring(0,s),n.objectName=r)}if(n.propertyName===null||n.propertyName.length===0)throw new Error("THREE.PropertyBinding: can not parse propertyName from trackName: "+t);return n}static findNode(t,e){if(e===void 0||e===""||e==="."||e===-1||e===t.name||e===t.uuid)return t;if(t.skeleton){let n=t.skeleton.getBoneByName(e);if(n!==void 0)return n}if(t.children){let n=function(r){for(let o=0;o<r.length;o++){let a=r[o];if(a.name===e||a.uuid===e)return a;let l=n(a.children);if(l)return l}return null},s=n(t.children);if(s)return s}return null}_getValue_unavailable(){}_setValue_unavailable(){}_getValue_direct(t,e){t[e]=this.targetObject[this.propertyName]}_getValue_array(t,e){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)t[e++]=n[s]}_getValue_arrayElement(t,e){t[e]=this.resolvedProperty[this.propertyIndex]}_getValue_toArray(t,e){this.resolvedProperty.toArray(t,e)}_setValue_direct(t,e){this.targetObject[this.propertyName]=t[e]}_setValue_direct_setNeedsUpdate(t,e){this.targetObject[this.propertyName]=t[e],this.targetObject.needsUpdate=!0}_setValue_direct_setMatrixWorldNeedsUpdate(t,e){this.targetObject[this.propertyName]=t[e],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_array(t,e){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=t[e++]}_setValue_array_setNeedsUpdate(t,e){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=t[e++];this.targetObject.needsUpdate=!0}_setValue_array_setMatrixWorldNeedsUpdate(t,e){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=t[e++];this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_arrayElement(t,e){this.resolvedProperty[this.propertyIndex]=t[e]}_setValue_arrayElement_setNeedsUpdate(t,e){this.resolvedProperty[this.propertyIndex]=t[e],this.targetObject.needsUpdate=!0}_setValue_arrayElement_setMatrixWorldNeedsUpdate(t,e){this.resolvedProperty[this.propertyIndex]=t[e],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_fromArray(t,e){this.resolvedProperty.fromArray(t,e)}_setValue_fromArray_setNeedsUpdate(t,e){this.resolvedProperty.fromArray(t,e),this.targetObject.needsUpdate=!0}_setValue_fromArray_setMatrixWorldNeedsUpdate(t,e){this.resolvedProperty.fromArray(t,e),this.targetObject.matrixWorldNeedsUpdate=!0}_getValue_unbound(t,e){this.bind(),this.getValue(t,e)}_setValue_unbound(t,e){this.bind(),this.setValue(t,e)}bind(){let t=this.node,e=this.parsedPath,n=e.objectName,s=e.propertyName,r=e.propertyIndex;if(t||(t=i.findNode(this.rootNode,e.nodeName),this.node=t),this.getValue=this._getValue_unavailable,this.setValue=this._setValue_unavailable,!t){Yt("PropertyBinding: No target node found for track: "+this.path+".");return}if(n){let c=e.objectIndex;switch(n){case"materials":if(!t.material){Qt("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!t.material.materials){Qt("PropertyBinding: Can not bind to material.materials as node.material does not have a materials array.",this);return}t=t.material.materials;break;case"bones":if(!t.skeleton){Qt("PropertyBinding: Can not bind to bones as node does not have a skeleton.",this);return}t=t.skeleton.bones;for(let f=0;f<t.length;f++)if(t[f].name===c){c=f;break}break;case"map":if("map"in t){t=t.map;break}if(!t.material){Qt("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!t.material.map){Qt("PropertyBinding: Can not bind to material.map as node.material does not have a map.",this);return}t=t.material.map;break;default:if(t[n]===void 0){Qt("PropertyBinding: Can not bind to objectName of node undefined.",this);return}t=t[n]}if(c!==void 0){if(t[c]===void 0){Qt("PropertyBinding: Trying to bind to objectIndex of objectName, but is undefined.",this,t);return}t=t[c]}}let o=t[s];if(o===void 0){let c=e.nodeName;Qt("PropertyBinding: Trying to update property for track: "+c+"."+s+" but it wasn't found.",t);return}let a=this.Versioning.None;this.targetObject=t,t.isMaterial===!0?a=this.Versioning.NeedsUpdate:t.isObject3D===!0&&(a=this.Versioning.MatrixWorldNeedsUpdate);let l=this.BindingType.Direct;if(r!==void 0){if(s==="morphTargetInfluences"){if(!t.geometry){Qt("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.",this);return}if(!t.geometry.morphAttributes){Qt("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.morphAttributes.",this);return}t.morphTargetDictionary[r]!==void 0&&(r=t.morphTargetDictionary[r])}l=this.BindingType.ArrayElement,this.resolvedProperty=o,this.propertyIndex=r}else o.fromArray!==void 0&&o.toArray!==void 0?(l=this.BindingType.HasFromToArray,this.resolvedProperty=o):Array.isArray(o)?(l=this.BindingType.EntireArray,this.resolvedProperty=o):this.propertyName=s;this.getValue=this.GetterByBindingType[l],this.setValue=this.SetterByBindingTypeAndVersioning[l][a]}unbind(){this.node=null,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}};Ke.Composite=ed;Ke.prototype.BindingType={Direct:0,EntireArray:1,ArrayElement:2,HasFromToArray:3};Ke.prototype.Versioning={None:0,NeedsUpdate:1,MatrixWorldNeedsUpdate:2};Ke.prototype.GetterByBindingType=[Ke.prototype._getValue_direct,Ke.prototype._getValue_array,Ke.prototype._getValue_arrayElement,Ke.prototype._getValue_toArray];Ke.prototype.SetterByBindingTypeAndVersioning=[[Ke.prototype._setValue_direct,Ke.prototype._setValue_direct_setNeedsUpdate,Ke.prototype._setValue_direct_setMatrixWorldNeedsUpdate],[Ke.prototype._setValue_array,Ke.prototype._setValue_array_setNeedsUpdate,Ke.prototype._setValue_array_setMatrixWorldNeedsUpdate],[Ke.prototype._setValue_arrayElement,Ke.prototype._setValue_arrayElement_setNeedsUpdate,Ke.prototype._setValue_arrayElement_setMatrixWorldNeedsUpdate],[Ke.prototype._setValue_fromArray,Ke.prototype._setValue_fromArray_setNeedsUpdate,Ke.prototype._setValue_fromArray_setMatrixWorldNeedsUpdate]];var zC=new Float32Array(1);var yg=new te,Qa=class{constructor(t,e,n=0,s=1/0){this.ray=new os(t,e),this.near=n,this.far=s,this.camera=null,this.layers=new To,this.params={Mesh:{},Line:{threshold:1},LOD:{},Points:{threshold:1},Sprite:{}}}set(t,e){this.ray.set(t,e)}setFromCamera(t,e){e.isPerspectiveCamera?(this.ray.origin.setFromMatrixPosition(e.matrixWorld),this.ray.direction.set(t.x,t.y,.5).unproject(e).sub(this.ray.origin).normalize(),this.camera=e):e.isOrthographicCamera?(this.ray.origin.set(t.x,t.y,e.projectionMatrix.elements[14]).unproject(e),this.ray.direction.set(0,0,-1).transformDirection(e.matrixWorld),this.camera=e):Qt("Raycaster: Unsupported camera type: "+e.type)}setFromXRController(t){return yg.identity().extractRotation(t.matrixWorld),this.ray.origin.setFromMatrixPosition(t.matrixWorld),this.ray.direction.set(0,0,-1).applyMatrix4(yg),this}intersectObject(t,e=!0,n=[]){return nd(t,this,n,e),n.sort(vg),n}intersectObjects(t,e=!0,n=[]){for(let s=0,r=t.length;s<r;s++)nd(t[s],this,n,e);return n.sort(vg),n}};function vg(i,t){return i.distance-t.distance}function nd(i,t,e,n){let s=!0;if(i.layers.test(t.layers)&&i.raycast(t,e)===!1&&(s=!1),s===!0&&n===!0){let r=i.children;for(let o=0,a=r.length;o<a;o++)nd(r[o],t,e,!0)}}var Io=class{constructor(t=1,e=0,n=0){this.radius=t,this.phi=e,this.theta=n}set(t,e,n){return this.radius=t,this.phi=e,this.theta=n,this}copy(t){return this.radius=t.radius,this.phi=t.phi,this.theta=t.theta,this}makeSafe(){return this.phi=ae(this.phi,1e-6,Math.PI-1e-6),this}setFromVector3(t){return this.setFromCartesianCoords(t.x,t.y,t.z)}setFromCartesianCoords(t,e,n){return this.radius=Math.sqrt(t*t+e*e+n*n),this.radius===0?(this.theta=0,this.phi=0):(this.theta=Math.atan2(t,n),this.phi=Math.acos(ae(e/this.radius,-1,1))),this}clone(){return new this.constructor().copy(this)}};var Xd=class Xd{constructor(t,e,n,s){this.elements=[1,0,0,1],t!==void 0&&this.set(t,e,n,s)}identity(){return this.set(1,0,0,1),this}fromArray(t,e=0){for(let n=0;n<4;n++)this.elements[n]=t[n+e];return this}set(t,e,n,s){let r=this.elements;return r[0]=t,r[2]=e,r[1]=n,r[3]=s,this}};Xd.prototype.isMatrix2=!0;var id=Xd;var Sg=new U,uc=new U,_o=new U,xo=new U,$f=new U,Zv=new U,$v=new U,oi=class{constructor(t=new U,e=new U){this.start=t,this.end=e}set(t,e){return this.start.copy(t),this.end.copy(e),this}copy(t){return this.start.copy(t.start),this.end.copy(t.end),this}getCenter(t){return t.addVectors(this.start,this.end).multiplyScalar(.5)}delta(t){return t.subVectors(this.end,this.start)}distanceSq(){return this.start.distanceToSquared(this.end)}distance(){return this.start.distanceTo(this.end)}at(t,e){return this.delta(e).multiplyScalar(t).add(this.start)}closestPointToPointParameter(t,e){Sg.subVectors(t,this.start),uc.subVectors(this.end,this.start);let n=uc.dot(uc);if(n===0)return 0;let r=uc.dot(Sg)/n;return e&&(r=ae(r,0,1)),r}closestPointToPoint(t,e,n){let s=this.closestPointToPointParameter(t,e);return this.delta(n).multiplyScalar(s).add(this.start)}distanceSqToLine3(t,e=Zv,n=$v){let s=10000000000000001e-32,r,o,a=this.start,l=t.start,c=this.end,f=t.end;_o.subVectors(c,a),xo.subVectors(f,l),$f.subVectors(a,l);let u=_o.dot(_o),h=xo.dot(xo),d=xo.dot($f);if(u<=s&&h<=s)return e.copy(a),n.copy(l),e.distanceToSquared(n);if(u<=s)r=0,o=d/h,o=ae(o,0,1);else{let g=_o.dot($f);if(h<=s)o=0,r=ae(-g/u,0,1);else{let v=_o.dot(xo),m=u*h-v*v;m!==0?r=ae((v*d-g*h)/m,0,1):r=0,o=(v*r+d)/h,o<0?(o=0,r=ae(-g/u,0,1)):o>1&&(o=1,r=ae((v-g)/u,0,1))}}return e.copy(a).addScaledVector(_o,r),n.copy(l).addScaledVector(xo,o),e.distanceToSquared(n)}applyMatrix4(t){return this.start.applyMatrix4(t),this.end.applyMatrix4(t),this}equals(t){return t.start.equals(this.start)&&t.end.equals(this.end)}clone(){return new this.constructor().copy(this)}};var tl=class extends Tr{constructor(t=10,e=10,n=4473924,s=8947848){n=new $t(n),s=new $t(s);let r=e/2,o=t/e,a=t/2,l=[],c=[];for(let h=0,d=0,g=-a;h<=e;h++,g+=o){l.push(-a,0,g,a,0,g),l.push(g,0,-a,g,0,a);let v=h===r?n:s;v.toArray(c,d),d+=3,v.toArray(c,d),d+=3,v.toArray(c,d),d+=3,v.toArray(c,d),d+=3}let f=new pn;f.setAttribute("position",new Xe(l,3)),f.setAttribute("color",new Xe(c,3));let u=new as({vertexColors:!0,toneMapped:!1});super(f,u),this.type="GridHelper"}dispose(){super.dispose(),this.geometry.dispose(),this.material.dispose()}};var el=class extends Tr{constructor(t,e=16776960){let n=new Uint16Array([0,1,1,2,2,3,3,0,4,5,5,6,6,7,7,4,0,4,1,5,2,6,3,7]),s=[1,1,1,-1,1,1,-1,-1,1,1,-1,1,1,1,-1,-1,1,-1,-1,-1,-1,1,-1,-1],r=new pn;r.setIndex(new Je(n,1)),r.setAttribute("position",new Xe(s,3)),super(r,new as({color:e,toneMapped:!1})),this.box=t,this.type="Box3Helper",this.geometry.computeBoundingSphere()}updateMatrixWorld(t){let e=this.box;e.isEmpty()||(e.getCenter(this.position),e.getSize(this.scale),this.scale.multiplyScalar(.5),super.updateMatrixWorld(t))}dispose(){super.dispose(),this.geometry.dispose(),this.material.dispose()}};var nl=class extends Vi{constructor(t,e=null){super(),this.object=t,this.domElement=e,this.enabled=!0,this.state=-1,this.keys={},this.mouseButtons={LEFT:null,MIDDLE:null,RIGHT:null},this.touches={ONE:null,TWO:null}}connect(t){this.domElement!==null&&this.disconnect(),this.domElement=t}disconnect(){}dispose(){}update(){}};function kd(i,t,e,n){let s=Kv(n);switch(e){case bd:return i*t;case Fo:return i*t/s.components*s.byteLength;case Jc:return i*t/s.components*s.byteLength;case rr:return i*t*2/s.components*s.byteLength;case jc:return i*t*2/s.components*s.byteLength;case wd:return i*t*3/s.components*s.byteLength;case Xi:return i*t*4/s.components*s.byteLength;case Qc:return i*t*4/s.components*s.byteLength;case rl:case ol:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*8;case al:case ll:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*16;case eh:case ih:return Math.max(i,16)*Math.max(t,8)/4;case th:case nh:return Math.max(i,8)*Math.max(t,8)/2;case sh:case rh:case ah:case lh:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*8;case oh:case cl:case ch:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*16;case hh:return Math.floor((i+3)/4)*Math.floor((t+3)/4)*16;case uh:return Math.floor((i+4)/5)*Math.floor((t+3)/4)*16;case fh:return Math.floor((i+4)/5)*Math.floor((t+4)/5)*16;case dh:return Math.floor((i+5)/6)*Math.floor((t+4)/5)*16;case ph:return Math.floor((i+5)/6)*Math.floor((t+5)/6)*16;case mh:return Math.floor((i+7)/8)*Math.floor((t+4)/5)*16;case gh:return Math.floor((i+7)/8)*Math.floor((t+5)/6)*16;case _h:return Math.floor((i+7)/8)*Math.floor((t+7)/8)*16;case xh:return Math.floor((i+9)/10)*Math.floor((t+4)/5)*16;case yh:return Math.floor((i+9)/10)*Math.floor((t+5)/6)*16;case vh:return Math.floor((i+9)/10)*Math.floor((t+7)/8)*16;case Sh:return Math.floor((i+9)/10)*Math.floor((t+9)/10)*16;case Mh:return Math.floor((i+11)/12)*Math.floor((t+9)/10)*16;case bh:return Math.floor((i+11)/12)*Math.floor((t+11)/12)*16;case wh:case Th:case Ah:return Math.ceil(i/4)*Math.ceil(t/4)*16;case Eh:case Ch:return Math.ceil(i/4)*Math.ceil(t/4)*8;case hl:case Rh:return Math.ceil(i/4)*Math.ceil(t/4)*16}throw new Error(`Unable to determine texture byte length for ${e} format.`)}function Kv(i){switch(i){case hi:case yd:return{byteLength:1,components:1};case Uo:case vd:case Wi:return{byteLength:2,components:1};case $c:case Kc:return{byteLength:2,components:4};case Hi:case Zc:case ui:return{byteLength:4,components:1};case Sd:case Md:return{byteLength:4,components:3}}throw new Error(`THREE.TextureUtils: Unknown texture type ${i}.`)}typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("register",{detail:{revision:"187"}}));typeof window<"u"&&(window.__THREE__?Yt("WARNING: Multiple instances of Three.js being imported."):window.__THREE__="187");/**
 * @license
 * Copyright 2010-2026 Three.js Authors
 * SPDX-License-Identifier: MIT
 */function I0(){let i=null,t=!1,e=null,n=null;function s(r,o){n=i.requestAnimationFrame(s),e(r,o)}return{start:function(){t!==!0&&e!==null&&i!==null&&(n=i.requestAnimationFrame(s),t=!0)},stop:function(){i!==null&&i.cancelAnimationFrame(n),t=!1},setAnimationLoop:function(r){e=r},setContext:function(r){i=r}}}function Jv(i){let t=new WeakMap;function e(a,l){let c=a.array,f=a.usage,u=c.byteLength,h=i.createBuffer();i.bindBuffer(l,h),i.bufferData(l,c,f),a.onUploadCallback();let d;if(c instanceof Float32Array)d=i.FLOAT;else if(typeof Float16Array<"u"&&c instanceof Float16Array)d=i.HALF_FLOAT;else if(c instanceof Uint16Array)a.isFloat16BufferAttribute?d=i.HALF_FLOAT:d=i.UNSIGNED_SHORT;else if(c instanceof Int16Array)d=i.SHORT;else if(c instanceof Uint32Array)d=i.UNSIGNED_INT;else if(c instanceof Int32Array)d=i.INT;else if(c instanceof Int8Array)d=i.BYTE;else if(c instanceof Uint8Array)d=i.UNSIGNED_BYTE;else if(c instanceof Uint8ClampedArray)d=i.UNSIGNED_BYTE;else throw new Error("THREE.WebGLAttributes: Unsupported buffer data format: "+c);return{buffer:h,type:d,bytesPerElement:c.BYTES_PER_ELEMENT,version:a.version,size:u}}function n(a,l,c){let f=l.array,u=l.updateRanges;if(i.bindBuffer(c,a),u.length===0)i.bufferSubData(c,0,f);else{u.sort((d,g)=>d.start-g.start);let h=0;for(let d=1;d<u.length;d++){let g=u[h],v=u[d];v.start<=g.start+g.count+1?g.count=Math.max(g.count,v.start+v.count-g.start):(++h,u[h]=v)}u.length=h+1;for(let d=0,g=u.length;d<g;d++){let v=u[d];i.bufferSubData(c,v.start*f.BYTES_PER_ELEMENT,f,v.start,v.count)}l.clearUpdateRanges()}l.onUploadCallback()}function s(a){return a.isInterleavedBufferAttribute&&(a=a.data),t.get(a)}function r(a){a.isInterleavedBufferAttribute&&(a=a.data);let l=t.get(a);l&&(i.deleteBuffer(l.buffer),t.delete(a))}function o(a,l){if(a.isInterleavedBufferAttribute&&(a=a.data),a.isGLBufferAttribute){let f=t.get(a);(!f||f.version<a.version)&&t.set(a,{buffer:a.buffer,type:a.type,bytesPerElement:a.elementSize,version:a.version});return}let c=t.get(a);if(c===void 0)t.set(a,e(a,l));else if(c.version<a.version){if(c.size!==a.array.byteLength)throw new Error("THREE.WebGLAttributes: The size of the buffer attribute's array buffer does not match the original size. Resizing buffer attributes is not supported.");n(c.buffer,a,l),c.version=a.version}}return{get:s,remove:r,update:o}}var jv=`#ifdef USE_ALPHAHASH
	if ( diffuseColor.a < getAlphaHashThreshold( vPosition ) ) discard;
#endif`,Qv=`#ifdef USE_ALPHAHASH
	const float ALPHA_HASH_SCALE = 0.05;
	float hash2D( vec2 value ) {
		return fract( 1.0e4 * sin( 17.0 * value.x + 0.1 * value.y ) * ( 0.1 + abs( sin( 13.0 * value.y + value.x ) ) ) );
	}
	float hash3D( vec3 value ) {
		return hash2D( vec2( hash2D( value.xy ), value.z ) );
	}
	float getAlphaHashThreshold( vec3 position ) {
		float maxDeriv = max(
			length( dFdx( position.xyz ) ),
			length( dFdy( position.xyz ) )
		);
		float pixScale = 1.0 / ( ALPHA_HASH_SCALE * maxDeriv );
		vec2 pixScales = vec2(
			exp2( floor( log2( pixScale ) ) ),
			exp2( ceil( log2( pixScale ) ) )
		);
		vec2 alpha = vec2(
			hash3D( floor( pixScales.x * position.xyz ) ),
			hash3D( floor( pixScales.y * position.xyz ) )
		);
		float lerpFactor = fract( log2( pixScale ) );
		float x = ( 1.0 - lerpFactor ) * alpha.x + lerpFactor * alpha.y;
		float a = min( lerpFactor, 1.0 - lerpFactor );
		vec3 cases = vec3(
			x * x / ( 2.0 * a * ( 1.0 - a ) ),
			( x - 0.5 * a ) / ( 1.0 - a ),
			1.0 - ( ( 1.0 - x ) * ( 1.0 - x ) / ( 2.0 * a * ( 1.0 - a ) ) )
		);
		float threshold = ( x < ( 1.0 - a ) )
			? ( ( x < a ) ? cases.x : cases.y )
			: cases.z;
		return clamp( threshold , 1.0e-6, 1.0 );
	}
#endif`,tS=`#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, vAlphaMapUv ).g;
#endif`,eS=`#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,nS=`#ifdef USE_ALPHATEST
	#ifdef ALPHA_TO_COVERAGE
	diffuseColor.a = smoothstep( alphaTest, alphaTest + fwidth( diffuseColor.a ), diffuseColor.a );
	if ( diffuseColor.a == 0.0 ) discard;
	#else
	if ( diffuseColor.a < alphaTest ) discard;
	#endif
#endif`,iS=`#ifdef USE_ALPHATEST
	uniform float alphaTest;
#endif`,sS=`#ifdef USE_AOMAP
	float ambientOcclusion = ( texture2D( aoMap, vAoMapUv ).r - 1.0 ) * aoMapIntensity + 1.0;
	reflectedLight.indirectDiffuse *= ambientOcclusion;
	#if defined( USE_CLEARCOAT ) 
		clearcoatSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_SHEEN ) 
		sheenSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_ENVMAP ) && defined( STANDARD )
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		reflectedLight.indirectSpecular *= computeSpecularOcclusion( dotNV, ambientOcclusion, material.roughness );
	#endif
#endif`,rS=`#ifdef USE_AOMAP
	uniform sampler2D aoMap;
	uniform float aoMapIntensity;
#endif`,oS=`#ifdef USE_BATCHING
	#if ! defined( GL_ANGLE_multi_draw )
	#define gl_DrawID _gl_DrawID
	uniform int _gl_DrawID;
	#endif
	uniform highp sampler2D batchingTexture;
	uniform highp usampler2D batchingIdTexture;
	mat4 getBatchingMatrix( const in float i ) {
		int size = textureSize( batchingTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( batchingTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( batchingTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( batchingTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( batchingTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
	float getIndirectIndex( const in int i ) {
		int size = textureSize( batchingIdTexture, 0 ).x;
		int x = i % size;
		int y = i / size;
		return float( texelFetch( batchingIdTexture, ivec2( x, y ), 0 ).r );
	}
#endif
#ifdef USE_BATCHING_COLOR
	uniform sampler2D batchingColorTexture;
	vec4 getBatchingColor( const in float i ) {
		int size = textureSize( batchingColorTexture, 0 ).x;
		int j = int( i );
		int x = j % size;
		int y = j / size;
		return texelFetch( batchingColorTexture, ivec2( x, y ), 0 );
	}
#endif`,aS=`#ifdef USE_BATCHING
	mat4 batchingMatrix = getBatchingMatrix( getIndirectIndex( gl_DrawID ) );
#endif`,lS=`vec3 transformed = vec3( position );
#ifdef USE_ALPHAHASH
	vPosition = vec3( position );
#endif`,cS=`vec3 objectNormal = vec3( normal );
#ifdef USE_TANGENT
	vec3 objectTangent = vec3( tangent.xyz );
#endif`,hS=`float G_BlinnPhong_Implicit( ) {
	return 0.25;
}
float D_BlinnPhong( const in float shininess, const in float dotNH ) {
	return RECIPROCAL_PI * ( shininess * 0.5 + 1.0 ) * pow( dotNH, shininess );
}
vec3 BRDF_BlinnPhong( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 specularColor, const in float shininess ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( specularColor, 1.0, dotVH );
	float G = G_BlinnPhong_Implicit( );
	float D = D_BlinnPhong( shininess, dotNH );
	return F * ( G * D );
} // validated`,uS=`#ifdef USE_IRIDESCENCE
	const mat3 XYZ_TO_REC709 = mat3(
		 3.2404542, -0.9692660,  0.0556434,
		-1.5371385,  1.8760108, -0.2040259,
		-0.4985314,  0.0415560,  1.0572252
	);
	vec3 Fresnel0ToIor( vec3 fresnel0 ) {
		vec3 sqrtF0 = sqrt( fresnel0 );
		return ( vec3( 1.0 ) + sqrtF0 ) / ( vec3( 1.0 ) - sqrtF0 );
	}
	vec3 IorToFresnel0( vec3 transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - vec3( incidentIor ) ) / ( transmittedIor + vec3( incidentIor ) ) );
	}
	float IorToFresnel0( float transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - incidentIor ) / ( transmittedIor + incidentIor ));
	}
	vec3 evalSensitivity( float OPD, vec3 shift ) {
		float phase = 2.0 * PI * OPD * 1.0e-9;
		vec3 val = vec3( 5.4856e-13, 4.4201e-13, 5.2481e-13 );
		vec3 pos = vec3( 1.6810e+06, 1.7953e+06, 2.2084e+06 );
		vec3 var = vec3( 4.3278e+09, 9.3046e+09, 6.6121e+09 );
		vec3 xyz = val * sqrt( 2.0 * PI * var ) * cos( pos * phase + shift ) * exp( - pow2( phase ) * var );
		xyz.x += 9.7470e-14 * sqrt( 2.0 * PI * 4.5282e+09 ) * cos( 2.2399e+06 * phase + shift[ 0 ] ) * exp( - 4.5282e+09 * pow2( phase ) );
		xyz /= 1.0685e-7;
		vec3 rgb = XYZ_TO_REC709 * xyz;
		return rgb;
	}
	vec3 evalIridescence( float outsideIOR, float eta2, float cosTheta1, float thinFilmThickness, vec3 baseF0 ) {
		vec3 I;
		float iridescenceIOR = mix( outsideIOR, eta2, smoothstep( 0.0, 0.03, thinFilmThickness ) );
		float sinTheta2Sq = pow2( outsideIOR / iridescenceIOR ) * ( 1.0 - pow2( cosTheta1 ) );
		float cosTheta2Sq = 1.0 - sinTheta2Sq;
		if ( cosTheta2Sq < 0.0 ) {
			return vec3( 1.0 );
		}
		float cosTheta2 = sqrt( cosTheta2Sq );
		float R0 = IorToFresnel0( iridescenceIOR, outsideIOR );
		float R12 = F_Schlick( R0, 1.0, cosTheta1 );
		float T121 = 1.0 - R12;
		float phi12 = 0.0;
		if ( iridescenceIOR < outsideIOR ) phi12 = PI;
		float phi21 = PI - phi12;
		vec3 baseIOR = Fresnel0ToIor( clamp( baseF0, 0.0, 0.9999 ) );		vec3 R1 = IorToFresnel0( baseIOR, iridescenceIOR );
		vec3 R23 = F_Schlick( R1, 1.0, cosTheta2 );
		vec3 phi23 = vec3( 0.0 );
		if ( baseIOR[ 0 ] < iridescenceIOR ) phi23[ 0 ] = PI;
		if ( baseIOR[ 1 ] < iridescenceIOR ) phi23[ 1 ] = PI;
		if ( baseIOR[ 2 ] < iridescenceIOR ) phi23[ 2 ] = PI;
		float OPD = 2.0 * iridescenceIOR * thinFilmThickness * cosTheta2;
		vec3 phi = vec3( phi21 ) + phi23;
		vec3 R123 = clamp( R12 * R23, 1e-5, 0.9999 );
		vec3 r123 = sqrt( R123 );
		vec3 Rs = pow2( T121 ) * R23 / ( vec3( 1.0 ) - R123 );
		vec3 C0 = R12 + Rs;
		I = C0;
		vec3 Cm = Rs - T121;
		for ( int m = 1; m <= 2; ++ m ) {
			Cm *= r123;
			vec3 Sm = 2.0 * evalSensitivity( float( m ) * OPD, float( m ) * phi );
			I += Cm * Sm;
		}
		return max( I, vec3( 0.0 ) );
	}
#endif`,fS=`#ifdef USE_BUMPMAP
	uniform sampler2D bumpMap;
	uniform float bumpScale;
	vec2 dHdxy_fwd() {
		vec2 dSTdx = dFdx( vBumpMapUv );
		vec2 dSTdy = dFdy( vBumpMapUv );
		float Hll = bumpScale * texture2D( bumpMap, vBumpMapUv ).x;
		float dBx = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdx ).x - Hll;
		float dBy = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdy ).x - Hll;
		return vec2( dBx, dBy );
	}
	vec3 perturbNormalArb( vec3 surf_pos, vec3 surf_norm, vec2 dHdxy, float faceDirection ) {
		vec3 vSigmaX = normalize( dFdx( surf_pos.xyz ) );
		vec3 vSigmaY = normalize( dFdy( surf_pos.xyz ) );
		vec3 vN = surf_norm;
		vec3 R1 = cross( vSigmaY, vN );
		vec3 R2 = cross( vN, vSigmaX );
		float fDet = dot( vSigmaX, R1 ) * faceDirection;
		vec3 vGrad = sign( fDet ) * ( dHdxy.x * R1 + dHdxy.y * R2 );
		return normalize( abs( fDet ) * surf_norm - vGrad );
	}
#endif`,dS=`#if NUM_CLIPPING_PLANES > 0
	vec4 plane;
	#ifdef ALPHA_TO_COVERAGE
		float distanceToPlane, distanceGradient;
		float clipOpacity = 1.0;
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
			distanceGradient = fwidth( distanceToPlane ) / 2.0;
			clipOpacity *= smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			if ( clipOpacity == 0.0 ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			float unionClipOpacity = 1.0;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
				distanceGradient = fwidth( distanceToPlane ) / 2.0;
				unionClipOpacity *= 1.0 - smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			}
			#pragma unroll_loop_end
			clipOpacity *= 1.0 - unionClipOpacity;
		#endif
		diffuseColor.a *= clipOpacity;
		if ( diffuseColor.a == 0.0 ) discard;
	#else
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			if ( dot( vClipPosition, plane.xyz ) > plane.w ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			bool clipped = true;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				clipped = ( dot( vClipPosition, plane.xyz ) > plane.w ) && clipped;
			}
			#pragma unroll_loop_end
			if ( clipped ) discard;
		#endif
	#endif
#endif`,pS=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
	uniform vec4 clippingPlanes[ NUM_CLIPPING_PLANES ];
#endif`,mS=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
#endif`,gS=`#if NUM_CLIPPING_PLANES > 0
	vClipPosition = - mvPosition.xyz;
#endif`,_S=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	diffuseColor *= vColor;
#endif`,xS=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#endif`,yS=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	varying vec4 vColor;
#endif`,vS=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	vColor = vec4( 1.0 );
#endif
#ifdef USE_COLOR_ALPHA
	vColor *= color;
#elif defined( USE_COLOR )
	vColor.rgb *= color;
#endif
#ifdef USE_INSTANCING_COLOR
	vColor.rgb *= instanceColor.rgb;
#endif
#ifdef USE_BATCHING_COLOR
	vColor *= getBatchingColor( getIndirectIndex( gl_DrawID ) );
#endif`,SS=`#define PI 3.141592653589793
#define PI2 6.283185307179586
#define PI_HALF 1.5707963267948966
#define RECIPROCAL_PI 0.3183098861837907
#define RECIPROCAL_PI2 0.15915494309189535
#define EPSILON 1e-6
#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
#define whiteComplement( a ) ( 1.0 - saturate( a ) )
float pow2( const in float x ) { return x*x; }
vec3 pow2( const in vec3 x ) { return x*x; }
float pow3( const in float x ) { return x*x*x; }
float pow4( const in float x ) { float x2 = x*x; return x2*x2; }
float max3( const in vec3 v ) { return max( max( v.x, v.y ), v.z ); }
float average( const in vec3 v ) { return dot( v, vec3( 0.3333333 ) ); }
highp float rand( const in vec2 uv ) {
	const highp float a = 12.9898, b = 78.233, c = 43758.5453;
	highp float dt = dot( uv.xy, vec2( a,b ) ), sn = mod( dt, PI );
	return fract( sin( sn ) * c );
}
#ifdef HIGH_PRECISION
	float precisionSafeLength( vec3 v ) { return length( v ); }
#else
	float precisionSafeLength( vec3 v ) {
		float maxComponent = max3( abs( v ) );
		return length( v / maxComponent ) * maxComponent;
	}
#endif
struct IncidentLight {
	vec3 color;
	vec3 direction;
	bool visible;
};
struct ReflectedLight {
	vec3 directDiffuse;
	vec3 directSpecular;
	vec3 indirectDiffuse;
	vec3 indirectSpecular;
};
#ifdef USE_ALPHAHASH
	varying vec3 vPosition;
#endif
vec3 transformDirection( in vec3 dir, in mat4 matrix ) {
	return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );
}
#define inverseTransformDirection transformDirectionByInverseViewMatrix
vec3 transformNormalByInverseViewMatrix( in vec3 normal, in mat4 viewMatrix ) {
	return normalize( ( vec4( normal, 0.0 ) * viewMatrix ).xyz );
}
vec3 transformDirectionByInverseViewMatrix( in vec3 dir, in mat4 viewMatrix ) {
	return normalize( ( vec4( dir, 0.0 ) * viewMatrix ).xyz );
}
bool isPerspectiveMatrix( mat4 m ) {
	return m[ 2 ][ 3 ] == - 1.0;
}
vec2 equirectUv( in vec3 dir ) {
	float u = atan( dir.z, dir.x ) * RECIPROCAL_PI2 + 0.5;
	float v = asin( clamp( dir.y, - 1.0, 1.0 ) ) * RECIPROCAL_PI + 0.5;
	return vec2( u, v );
}
vec3 BRDF_Lambert( const in vec3 diffuseColor ) {
	return RECIPROCAL_PI * diffuseColor;
}
vec3 F_Schlick( const in vec3 f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
}
float F_Schlick( const in float f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
} // validated`,MS=`vec3 transformedNormal = objectNormal;
#ifdef USE_TANGENT
	vec3 transformedTangent = objectTangent;
#endif
#ifdef USE_BATCHING
	mat3 bm = mat3( batchingMatrix );
	transformedNormal /= vec3( dot( bm[ 0 ], bm[ 0 ] ), dot( bm[ 1 ], bm[ 1 ] ), dot( bm[ 2 ], bm[ 2 ] ) );
	transformedNormal = bm * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = bm * transformedTangent;
	#endif
#endif
#ifdef USE_INSTANCING
	mat3 im = mat3( instanceMatrix );
	transformedNormal /= vec3( dot( im[ 0 ], im[ 0 ] ), dot( im[ 1 ], im[ 1 ] ), dot( im[ 2 ], im[ 2 ] ) );
	transformedNormal = im * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = im * transformedTangent;
	#endif
#endif
transformedNormal = normalMatrix * transformedNormal;
#ifdef FLIP_SIDED
	transformedNormal = - transformedNormal;
#endif
#ifdef USE_TANGENT
	transformedTangent = ( modelViewMatrix * vec4( transformedTangent, 0.0 ) ).xyz;
#endif`,bS=`#ifdef USE_DISPLACEMENTMAP
	uniform sampler2D displacementMap;
	uniform float displacementScale;
	uniform float displacementBias;
#endif`,wS=`#ifdef USE_DISPLACEMENTMAP
	transformed += normalize( objectNormal ) * ( texture2D( displacementMap, vDisplacementMapUv ).x * displacementScale + displacementBias );
#endif`,TS=`#ifdef USE_EMISSIVEMAP
	vec4 emissiveColor = texture2D( emissiveMap, vEmissiveMapUv );
	#ifdef DECODE_VIDEO_TEXTURE_EMISSIVE
		emissiveColor = sRGBTransferEOTF( emissiveColor );
	#endif
	totalEmissiveRadiance *= emissiveColor.rgb;
#endif`,AS=`#ifdef USE_EMISSIVEMAP
	uniform sampler2D emissiveMap;
#endif`,ES="gl_FragColor = linearToOutputTexel( gl_FragColor );",CS=`vec4 LinearTransferOETF( in vec4 value ) {
	return value;
}
vec4 sRGBTransferEOTF( in vec4 value ) {
	return vec4( mix( pow( value.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), value.rgb * 0.0773993808, vec3( lessThanEqual( value.rgb, vec3( 0.04045 ) ) ) ), value.a );
}
vec4 sRGBTransferOETF( in vec4 value ) {
	return vec4( mix( pow( value.rgb, vec3( 0.41666 ) ) * 1.055 - vec3( 0.055 ), value.rgb * 12.92, vec3( lessThanEqual( value.rgb, vec3( 0.0031308 ) ) ) ), value.a );
}`,RS=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vec3 cameraToFrag;
		if ( isOrthographic ) {
			cameraToFrag = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToFrag = normalize( vWorldPosition - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vec3 reflectVec = reflect( cameraToFrag, worldNormal );
		#else
			vec3 reflectVec = refract( cameraToFrag, worldNormal, refractionRatio );
		#endif
	#else
		vec3 reflectVec = vReflect;
	#endif
	#ifdef ENVMAP_TYPE_CUBE
		vec4 envColor = textureCube( envMap, envMapRotation * reflectVec );
		#ifdef ENVMAP_BLENDING_MULTIPLY
			outgoingLight = mix( outgoingLight, outgoingLight * envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_MIX )
			outgoingLight = mix( outgoingLight, envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_ADD )
			outgoingLight += envColor.xyz * specularStrength * reflectivity;
		#endif
	#endif
#endif`,PS=`#ifdef USE_ENVMAP
	uniform float envMapIntensity;
	uniform mat3 envMapRotation;
	uniform samplerCube envMap;
	#ifdef ENVMAP_TYPE_PMREM
		float roughnessToMip( const in float roughness ) {
			float r = clamp( roughness, 0.0, 1.0 );
			return ENVMAP_MAX_LOD * r * ( 2.0 - r );
		}
	#endif
#endif`,IS=`#ifdef USE_ENVMAP
	uniform float reflectivity;
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		varying vec3 vWorldPosition;
		uniform float refractionRatio;
	#else
		varying vec3 vReflect;
	#endif
#endif`,LS=`#ifdef USE_ENVMAP
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		
		varying vec3 vWorldPosition;
	#else
		varying vec3 vReflect;
		uniform float refractionRatio;
	#endif
#endif`,DS=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vWorldPosition = worldPosition.xyz;
	#else
		vec3 cameraToVertex;
		if ( isOrthographic ) {
			cameraToVertex = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToVertex = normalize( worldPosition.xyz - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vReflect = reflect( cameraToVertex, worldNormal );
		#else
			vReflect = refract( cameraToVertex, worldNormal, refractionRatio );
		#endif
	#endif
#endif`,NS=`#ifdef USE_FOG
	vFogDepth = - mvPosition.z;
#endif`,US=`#ifdef USE_FOG
	varying float vFogDepth;
#endif`,FS=`#ifdef USE_FOG
	#ifdef FOG_EXP2
		float fogFactor = 1.0 - exp( - fogDensity * fogDensity * vFogDepth * vFogDepth );
	#else
		float fogFactor = smoothstep( fogNear, fogFar, vFogDepth );
	#endif
	gl_FragColor.rgb = mix( gl_FragColor.rgb, fogColor, fogFactor );
#endif`,OS=`#ifdef USE_FOG
	uniform vec3 fogColor;
	varying float vFogDepth;
	#ifdef FOG_EXP2
		uniform float fogDensity;
	#else
		uniform float fogNear;
		uniform float fogFar;
	#endif
#endif`,BS=`#ifdef USE_GRADIENTMAP
	uniform sampler2D gradientMap;
#endif
vec3 getGradientIrradiance( vec3 normal, vec3 lightDirection ) {
	float dotNL = dot( normal, lightDirection );
	vec2 coord = vec2( dotNL * 0.5 + 0.5, 0.0 );
	#ifdef USE_GRADIENTMAP
		return vec3( texture2D( gradientMap, coord ).r );
	#else
		vec2 fw = fwidth( coord ) * 0.5;
		return mix( vec3( 0.7 ), vec3( 1.0 ), smoothstep( 0.7 - fw.x, 0.7 + fw.x, coord.x ) );
	#endif
}`,zS=`#ifdef USE_LIGHTMAP
	uniform sampler2D lightMap;
	uniform float lightMapIntensity;
#endif`,kS=`LambertMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularStrength = specularStrength;`,VS=`varying vec3 vViewPosition;
struct LambertMaterial {
	vec3 diffuseColor;
	float specularStrength;
};
void RE_Direct_Lambert( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Lambert( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Lambert
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Lambert`,GS=`uniform bool receiveShadow;
uniform vec3 ambientLightColor;
#if defined( USE_LIGHT_PROBES )
	uniform vec3 lightProbe[ 9 ];
#endif
vec3 shGetIrradianceAt( in vec3 normal, in vec3 shCoefficients[ 9 ] ) {
	float x = normal.x, y = normal.y, z = normal.z;
	vec3 result = shCoefficients[ 0 ] * 0.886227;
	result += shCoefficients[ 1 ] * 2.0 * 0.511664 * y;
	result += shCoefficients[ 2 ] * 2.0 * 0.511664 * z;
	result += shCoefficients[ 3 ] * 2.0 * 0.511664 * x;
	result += shCoefficients[ 4 ] * 2.0 * 0.429043 * x * y;
	result += shCoefficients[ 5 ] * 2.0 * 0.429043 * y * z;
	result += shCoefficients[ 6 ] * ( 0.743125 * z * z - 0.247708 );
	result += shCoefficients[ 7 ] * 2.0 * 0.429043 * x * z;
	result += shCoefficients[ 8 ] * 0.429043 * ( x * x - y * y );
	return result;
}
vec3 getLightProbeIrradiance( const in vec3 lightProbe[ 9 ], const in vec3 normal ) {
	vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec3 irradiance = shGetIrradianceAt( worldNormal, lightProbe );
	return irradiance;
}
vec3 getAmbientLightIrradiance( const in vec3 ambientLightColor ) {
	vec3 irradiance = ambientLightColor;
	return irradiance;
}
float getDistanceAttenuation( const in float lightDistance, const in float cutoffDistance, const in float decayExponent ) {
	float distanceFalloff = 1.0 / max( pow( lightDistance, decayExponent ), 0.01 );
	if ( cutoffDistance > 0.0 ) {
		distanceFalloff *= pow2( saturate( 1.0 - pow4( lightDistance / cutoffDistance ) ) );
	}
	return distanceFalloff;
}
float getSpotAttenuation( const in float coneCosine, const in float penumbraCosine, const in float angleCosine ) {
	return smoothstep( coneCosine, penumbraCosine, angleCosine );
}
#if NUM_SUN_LIGHTS > 0
	struct SunLight {
		vec3 direction;
		vec3 color;
	};
	uniform SunLight sunLights[ NUM_SUN_LIGHTS ];
	void getSunLightInfo( const in SunLight sunLight, out IncidentLight light ) {
		light.color = sunLight.color;
		light.direction = sunLight.direction;
		light.visible = true;
	}
#endif
#if NUM_DIR_LIGHTS > 0
	struct DirectionalLight {
		vec3 direction;
		vec3 color;
	};
	uniform DirectionalLight directionalLights[ NUM_DIR_LIGHTS ];
	void getDirectionalLightInfo( const in DirectionalLight directionalLight, out IncidentLight light ) {
		light.color = directionalLight.color;
		light.direction = directionalLight.direction;
		light.visible = true;
	}
#endif
#if NUM_POINT_LIGHTS > 0
	struct PointLight {
		vec3 position;
		vec3 color;
		float distance;
		float decay;
	};
	uniform PointLight pointLights[ NUM_POINT_LIGHTS ];
	void getPointLightInfo( const in PointLight pointLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = pointLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float lightDistance = length( lVector );
		light.color = pointLight.color;
		light.color *= getDistanceAttenuation( lightDistance, pointLight.distance, pointLight.decay );
		light.visible = ( light.color != vec3( 0.0 ) );
	}
#endif
#if NUM_SPOT_LIGHTS > 0
	struct SpotLight {
		vec3 position;
		vec3 direction;
		vec3 color;
		float distance;
		float decay;
		float coneCos;
		float penumbraCos;
	};
	uniform SpotLight spotLights[ NUM_SPOT_LIGHTS ];
	void getSpotLightInfo( const in SpotLight spotLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = spotLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float angleCos = dot( light.direction, spotLight.direction );
		float spotAttenuation = getSpotAttenuation( spotLight.coneCos, spotLight.penumbraCos, angleCos );
		if ( spotAttenuation > 0.0 ) {
			float lightDistance = length( lVector );
			light.color = spotLight.color * spotAttenuation;
			light.color *= getDistanceAttenuation( lightDistance, spotLight.distance, spotLight.decay );
			light.visible = ( light.color != vec3( 0.0 ) );
		} else {
			light.color = vec3( 0.0 );
			light.visible = false;
		}
	}
#endif
#if NUM_RECT_AREA_LIGHTS > 0
	struct RectAreaLight {
		vec3 color;
		vec3 position;
		vec3 halfWidth;
		vec3 halfHeight;
	};
	uniform sampler2D ltc_1;	uniform sampler2D ltc_2;
	uniform RectAreaLight rectAreaLights[ NUM_RECT_AREA_LIGHTS ];
#endif
#if NUM_HEMI_LIGHTS > 0
	struct HemisphereLight {
		vec3 direction;
		vec3 skyColor;
		vec3 groundColor;
	};
	uniform HemisphereLight hemisphereLights[ NUM_HEMI_LIGHTS ];
	vec3 getHemisphereLightIrradiance( const in HemisphereLight hemiLight, const in vec3 normal ) {
		float dotNL = dot( normal, hemiLight.direction );
		float hemiDiffuseWeight = 0.5 * dotNL + 0.5;
		vec3 irradiance = mix( hemiLight.groundColor, hemiLight.skyColor, hemiDiffuseWeight );
		return irradiance;
	}
#endif
#include <lightprobes_pars_fragment>`,HS=`#ifdef USE_ENVMAP
	vec3 getIBLIrradiance( const in vec3 normal ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * worldNormal, ENVMAP_MAX_LOD );
			return PI * envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	vec3 getIBLRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 reflectVec = reflect( - viewDir, normal );
			reflectVec = normalize( mix( reflectVec, normal, pow4( roughness ) ) );
			reflectVec = transformDirectionByInverseViewMatrix( reflectVec, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * reflectVec, roughnessToMip( roughness ) );
			return envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	#ifdef USE_RETROREFLECTION
		vec3 getIBLRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 retroVec = normalize( mix( viewDir, normal, pow4( roughness ) ) );
				retroVec = transformDirectionByInverseViewMatrix( retroVec, viewMatrix );
				vec4 envMapColor = textureLod( envMap, envMapRotation * retroVec, roughnessToMip( roughness ) );
				return envMapColor.rgb * envMapIntensity;
			#else
				return vec3( 0.0 );
			#endif
		}
	#endif
	#ifdef USE_ANISOTROPY
		vec3 getIBLAnisotropyRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 bentNormal = cross( bitangent, viewDir );
				bentNormal = normalize( cross( bentNormal, bitangent ) );
				bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
				return getIBLRadiance( viewDir, bentNormal, roughness );
			#else
				return vec3( 0.0 );
			#endif
		}
		#ifdef USE_RETROREFLECTION
			vec3 getIBLAnisotropyRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
				#ifdef ENVMAP_TYPE_PMREM
					vec3 bentNormal = cross( bitangent, viewDir );
					bentNormal = normalize( cross( bentNormal, bitangent ) );
					bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
					return getIBLRetroRadiance( viewDir, bentNormal, roughness );
				#else
					return vec3( 0.0 );
				#endif
			}
		#endif
	#endif
#endif`,WS=`ToonMaterial material;
material.diffuseColor = diffuseColor.rgb;`,XS=`varying vec3 vViewPosition;
struct ToonMaterial {
	vec3 diffuseColor;
};
void RE_Direct_Toon( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 irradiance = getGradientIrradiance( geometryNormal, directLight.direction ) * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Toon( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Toon
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Toon`,qS=`BlinnPhongMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularColor = specular;
material.specularShininess = shininess;
material.specularStrength = specularStrength;`,YS=`varying vec3 vViewPosition;
struct BlinnPhongMaterial {
	vec3 diffuseColor;
	vec3 specularColor;
	float specularShininess;
	float specularStrength;
};
void RE_Direct_BlinnPhong( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
	reflectedLight.directSpecular += irradiance * BRDF_BlinnPhong( directLight.direction, geometryViewDir, geometryNormal, material.specularColor, material.specularShininess ) * material.specularStrength;
}
void RE_IndirectDiffuse_BlinnPhong( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_BlinnPhong
#define RE_IndirectDiffuse		RE_IndirectDiffuse_BlinnPhong`,ZS=`PhysicalMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.diffuseContribution = diffuseColor.rgb * ( 1.0 - metalnessFactor );
material.metalness = metalnessFactor;
vec3 dxy = max( abs( dFdx( nonPerturbedNormal ) ), abs( dFdy( nonPerturbedNormal ) ) );
float geometryRoughness = max( max( dxy.x, dxy.y ), dxy.z );
material.roughness = max( roughnessFactor, 0.045 );
material.roughness += geometryRoughness;
material.roughness = min( material.roughness, 1.0 );
#ifdef USE_DIFFUSE_ROUGHNESS
	float diffuseRoughnessFactor = diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		diffuseRoughnessFactor *= texture2D( diffuseRoughnessMap, vDiffuseRoughnessMapUv ).r;
	#endif
	material.diffuseRoughness = saturate( diffuseRoughnessFactor );
#endif
#ifdef IOR
	material.ior = ior;
	#ifdef USE_SPECULAR
		float specularIntensityFactor = specularIntensity;
		vec3 specularColorFactor = specularColor;
		#ifdef USE_SPECULAR_COLORMAP
			specularColorFactor *= texture2D( specularColorMap, vSpecularColorMapUv ).rgb;
		#endif
		#ifdef USE_SPECULAR_INTENSITYMAP
			specularIntensityFactor *= texture2D( specularIntensityMap, vSpecularIntensityMapUv ).a;
		#endif
		material.specularF90 = mix( specularIntensityFactor, 1.0, metalnessFactor );
	#else
		float specularIntensityFactor = 1.0;
		vec3 specularColorFactor = vec3( 1.0 );
		material.specularF90 = 1.0;
	#endif
	material.specularColor = min( pow2( ( material.ior - 1.0 ) / ( material.ior + 1.0 ) ) * specularColorFactor, vec3( 1.0 ) ) * specularIntensityFactor;
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
#else
	material.specularColor = vec3( 0.04 );
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
	material.specularF90 = 1.0;
#endif
#ifdef USE_CLEARCOAT
	material.clearcoat = clearcoat;
	material.clearcoatRoughness = clearcoatRoughness;
	material.clearcoatF0 = vec3( 0.04 );
	material.clearcoatF90 = 1.0;
	#ifdef USE_CLEARCOATMAP
		material.clearcoat *= texture2D( clearcoatMap, vClearcoatMapUv ).x;
	#endif
	#ifdef USE_CLEARCOAT_ROUGHNESSMAP
		material.clearcoatRoughness *= texture2D( clearcoatRoughnessMap, vClearcoatRoughnessMapUv ).y;
	#endif
	material.clearcoat = saturate( material.clearcoat );	material.clearcoatRoughness = max( material.clearcoatRoughness, 0.045 );
	material.clearcoatRoughness += geometryRoughness;
	material.clearcoatRoughness = min( material.clearcoatRoughness, 1.0 );
#endif
#ifdef USE_DISPERSION
	material.dispersion = dispersion;
#endif
#ifdef USE_RETROREFLECTION
	material.retroreflectivity = retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	material.iridescence = iridescence;
	material.iridescenceIOR = iridescenceIOR;
	#ifdef USE_IRIDESCENCEMAP
		material.iridescence *= texture2D( iridescenceMap, vIridescenceMapUv ).r;
	#endif
	#ifdef USE_IRIDESCENCE_THICKNESSMAP
		material.iridescenceThickness = (iridescenceThicknessMaximum - iridescenceThicknessMinimum) * texture2D( iridescenceThicknessMap, vIridescenceThicknessMapUv ).g + iridescenceThicknessMinimum;
	#else
		material.iridescenceThickness = iridescenceThicknessMaximum;
	#endif
#endif
#ifdef USE_SHEEN
	material.sheenColor = sheenColor;
	#ifdef USE_SHEEN_COLORMAP
		material.sheenColor *= texture2D( sheenColorMap, vSheenColorMapUv ).rgb;
	#endif
	material.sheenRoughness = clamp( sheenRoughness, 0.0001, 1.0 );
	#ifdef USE_SHEEN_ROUGHNESSMAP
		material.sheenRoughness *= texture2D( sheenRoughnessMap, vSheenRoughnessMapUv ).a;
	#endif
#endif
#ifdef USE_ANISOTROPY
	#ifdef USE_ANISOTROPYMAP
		mat2 anisotropyMat = mat2( anisotropyVector.x, anisotropyVector.y, - anisotropyVector.y, anisotropyVector.x );
		vec3 anisotropyPolar = texture2D( anisotropyMap, vAnisotropyMapUv ).rgb;
		vec2 anisotropyV = anisotropyMat * normalize( 2.0 * anisotropyPolar.rg - vec2( 1.0 ) ) * anisotropyPolar.b;
	#else
		vec2 anisotropyV = anisotropyVector;
	#endif
	material.anisotropy = length( anisotropyV );
	if( material.anisotropy == 0.0 ) {
		anisotropyV = vec2( 1.0, 0.0 );
	} else {
		anisotropyV /= material.anisotropy;
		material.anisotropy = saturate( material.anisotropy );
	}
	material.alphaT = mix( pow2( material.roughness ), 1.0, pow2( material.anisotropy ) );
	material.anisotropyT = tbn[ 0 ] * anisotropyV.x + tbn[ 1 ] * anisotropyV.y;
	material.anisotropyB = tbn[ 1 ] * anisotropyV.x - tbn[ 0 ] * anisotropyV.y;
#endif`,$S=`uniform sampler2D dfgLUT;
struct PhysicalMaterial {
	vec3 diffuseColor;
	vec3 diffuseContribution;
	vec3 specularColor;
	vec3 specularColorBlended;
	float roughness;
	float metalness;
	float specularF90;
	float dispersion;
	vec2 dfg;
	vec3 multiScatteringCompensation;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float diffuseRoughness;
	#endif
	#ifdef USE_RETROREFLECTION
		float retroreflectivity;
	#endif
	#ifdef USE_CLEARCOAT
		float clearcoat;
		float clearcoatRoughness;
		vec3 clearcoatF0;
		float clearcoatF90;
	#endif
	#ifdef USE_IRIDESCENCE
		float iridescence;
		float iridescenceIOR;
		float iridescenceThickness;
		vec3 iridescenceFresnel;
		vec3 iridescenceF0Dielectric;
		vec3 iridescenceF0Metallic;
	#endif
	#ifdef USE_SHEEN
		vec3 sheenColor;
		float sheenRoughness;
	#endif
	#ifdef IOR
		float ior;
	#endif
	#ifdef USE_TRANSMISSION
		float transmission;
		float transmissionAlpha;
		float thickness;
		float attenuationDistance;
		vec3 attenuationColor;
	#endif
	#ifdef USE_ANISOTROPY
		float anisotropy;
		float alphaT;
		vec3 anisotropyT;
		vec3 anisotropyB;
	#endif
};
vec3 clearcoatSpecularDirect = vec3( 0.0 );
vec3 clearcoatSpecularIndirect = vec3( 0.0 );
vec3 sheenSpecularDirect = vec3( 0.0 );
vec3 sheenSpecularIndirect = vec3(0.0 );
vec3 Schlick_to_F0( const in vec3 f, const in float f90, const in float dotVH ) {
    float x = clamp( 1.0 - dotVH, 0.0, 1.0 );
    float x2 = x * x;
    float x5 = clamp( x * x2 * x2, 0.0, 0.9999 );
    return ( f - vec3( f90 ) * x5 ) / ( 1.0 - x5 );
}
#ifdef USE_DIFFUSE_ROUGHNESS
	const float EON_EPSILON = 1e-7;
	float FON_DirectionalAlbedo( const in float mu, const in float roughness, const in float A ) {
		float muComp = 1.0 - mu;
		float gOverPi = muComp * ( 0.0571085289 + muComp * ( 0.491881867 + muComp * ( - 0.332181442 + muComp * 0.0714429953 ) ) );
		return A * ( 1.0 + roughness * gOverPi );
	}
	vec3 BRDF_EON( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 diffuseColor, const in float roughness ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return BRDF_Lambert( rho );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float s = dot( lightDir, viewDir ) - dotNL * dotNV;
		float sOverT = ( s > 0.0 ) ? s / max( max( dotNL, dotNV ), EON_EPSILON ) : s;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		vec3 singleScatter = rho * RECIPROCAL_PI * A * ( 1.0 + roughness * sOverT );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		float albedoV = FON_DirectionalAlbedo( dotNV, roughness, A );
		float albedoL = FON_DirectionalAlbedo( dotNL, roughness, A );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		vec3 multiScatter = rhoMultiScatter * RECIPROCAL_PI
			* max( EON_EPSILON, 1.0 - albedoV )
			* max( EON_EPSILON, 1.0 - albedoL )
			/ max( EON_EPSILON, 1.0 - averageAlbedo );
		return singleScatter + multiScatter;
	}
	vec3 EON_DirectionalAlbedo( const in vec3 diffuseColor, const in float roughness, const in float dotNV ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return rho;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		float directionalAlbedo = FON_DirectionalAlbedo( dotNV, roughness, A );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		return rho * directionalAlbedo + rhoMultiScatter * ( 1.0 - directionalAlbedo );
	}
#endif
float V_GGX_SmithCorrelated( const in float alpha, const in float dotNL, const in float dotNV ) {
	float a2 = pow2( alpha );
	float gv = dotNL * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNV ) );
	float gl = dotNV * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNL ) );
	return 0.5 / max( gv + gl, EPSILON );
}
float D_GGX( const in float alpha, const in float dotNH ) {
	float a2 = pow2( alpha );
	float denom = pow2( dotNH ) * ( a2 - 1.0 ) + 1.0;
	return RECIPROCAL_PI * a2 / pow2( denom );
}
#ifdef USE_ANISOTROPY
	float V_GGX_SmithCorrelated_Anisotropic( const in float alphaT, const in float alphaB, const in float dotTV, const in float dotBV, const in float dotTL, const in float dotBL, const in float dotNV, const in float dotNL ) {
		float gv = dotNL * length( vec3( alphaT * dotTV, alphaB * dotBV, dotNV ) );
		float gl = dotNV * length( vec3( alphaT * dotTL, alphaB * dotBL, dotNL ) );
		return 0.5 / max( gv + gl, EPSILON );
	}
	float D_GGX_Anisotropic( const in float alphaT, const in float alphaB, const in float dotNH, const in float dotTH, const in float dotBH ) {
		float a2 = alphaT * alphaB;
		highp vec3 v = vec3( alphaB * dotTH, alphaT * dotBH, a2 * dotNH );
		highp float v2 = dot( v, v );
		float w2 = a2 / v2;
		return RECIPROCAL_PI * a2 * pow2 ( w2 );
	}
#endif
#ifdef USE_CLEARCOAT
	vec3 BRDF_GGX_Clearcoat( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material) {
		vec3 f0 = material.clearcoatF0;
		float f90 = material.clearcoatF90;
		float roughness = max( material.clearcoatRoughness, 0.045 );
		float alpha = pow2( roughness );
		vec3 halfDir = normalize( lightDir + viewDir );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float dotNH = saturate( dot( normal, halfDir ) );
		float dotVH = saturate( dot( viewDir, halfDir ) );
		vec3 F = F_Schlick( f0, f90, dotVH );
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
		return F * ( V * D );
	}
#endif
vec3 BRDF_GGX( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material ) {
	vec3 f0 = material.specularColorBlended;
	float f90 = material.specularF90;
	float roughness = max( material.roughness, 0.045 );
	float alpha = pow2( roughness );
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( f0, f90, dotVH );
	#ifdef USE_IRIDESCENCE
		F = mix( F, material.iridescenceFresnel, material.iridescence );
	#endif
	#ifdef USE_ANISOTROPY
		float dotTL = dot( material.anisotropyT, lightDir );
		float dotTV = dot( material.anisotropyT, viewDir );
		float dotTH = dot( material.anisotropyT, halfDir );
		float dotBL = dot( material.anisotropyB, lightDir );
		float dotBV = dot( material.anisotropyB, viewDir );
		float dotBH = dot( material.anisotropyB, halfDir );
		float alphaT = max( material.alphaT, alpha );
		float V = V_GGX_SmithCorrelated_Anisotropic( alphaT, alpha, dotTV, dotBV, dotTL, dotBL, dotNV, dotNL );
		float D = D_GGX_Anisotropic( alphaT, alpha, dotNH, dotTH, dotBH );
	#else
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
	#endif
	return F * ( V * D );
}
vec2 LTC_Uv( const in vec3 N, const in vec3 V, const in float roughness ) {
	const float LUT_SIZE = 64.0;
	const float LUT_SCALE = ( LUT_SIZE - 1.0 ) / LUT_SIZE;
	const float LUT_BIAS = 0.5 / LUT_SIZE;
	float dotNV = saturate( dot( N, V ) );
	vec2 uv = vec2( roughness, sqrt( 1.0 - dotNV ) );
	uv = uv * LUT_SCALE + LUT_BIAS;
	return uv;
}
float LTC_ClippedSphereFormFactor( const in vec3 f ) {
	float l = length( f );
	return max( ( l * l + f.z ) / ( l + 1.0 ), 0.0 );
}
vec3 LTC_EdgeVectorFormFactor( const in vec3 v1, const in vec3 v2 ) {
	float x = dot( v1, v2 );
	float y = abs( x );
	float a = 0.8543985 + ( 0.4965155 + 0.0145206 * y ) * y;
	float b = 3.4175940 + ( 4.1616724 + y ) * y;
	float v = a / b;
	float theta_sintheta = ( x > 0.0 ) ? v : 0.5 * inversesqrt( max( 1.0 - x * x, 1e-7 ) ) - v;
	return cross( v1, v2 ) * theta_sintheta;
}
vec3 LTC_Evaluate( const in vec3 N, const in vec3 V, const in vec3 P, const in mat3 mInv, const in vec3 rectCoords[ 4 ] ) {
	vec3 v1 = rectCoords[ 1 ] - rectCoords[ 0 ];
	vec3 v2 = rectCoords[ 3 ] - rectCoords[ 0 ];
	vec3 lightNormal = cross( v1, v2 );
	if( dot( lightNormal, P - rectCoords[ 0 ] ) < 0.0 ) return vec3( 0.0 );
	vec3 T1, T2;
	T1 = normalize( V - N * dot( V, N ) );
	T2 = - cross( N, T1 );
	mat3 mat = mInv * transpose( mat3( T1, T2, N ) );
	vec3 coords[ 4 ];
	coords[ 0 ] = mat * ( rectCoords[ 0 ] - P );
	coords[ 1 ] = mat * ( rectCoords[ 1 ] - P );
	coords[ 2 ] = mat * ( rectCoords[ 2 ] - P );
	coords[ 3 ] = mat * ( rectCoords[ 3 ] - P );
	coords[ 0 ] = normalize( coords[ 0 ] );
	coords[ 1 ] = normalize( coords[ 1 ] );
	coords[ 2 ] = normalize( coords[ 2 ] );
	coords[ 3 ] = normalize( coords[ 3 ] );
	vec3 vectorFormFactor = vec3( 0.0 );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 0 ], coords[ 1 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 1 ], coords[ 2 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 2 ], coords[ 3 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 3 ], coords[ 0 ] );
	float result = LTC_ClippedSphereFormFactor( vectorFormFactor );
	return vec3( result );
}
#if defined( USE_SHEEN )
float D_Charlie( float roughness, float dotNH ) {
	float alpha = pow2( roughness );
	float invAlpha = 1.0 / alpha;
	float cos2h = dotNH * dotNH;
	float sin2h = max( 1.0 - cos2h, 0.0078125 );
	return ( 2.0 + invAlpha ) * pow( sin2h, invAlpha * 0.5 ) / ( 2.0 * PI );
}
float V_Neubelt( float dotNV, float dotNL ) {
	return saturate( 1.0 / ( 4.0 * ( dotNL + dotNV - dotNL * dotNV ) ) );
}
vec3 BRDF_Sheen( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, vec3 sheenColor, const in float sheenRoughness ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float D = D_Charlie( sheenRoughness, dotNH );
	float V = V_Neubelt( dotNV, dotNL );
	return sheenColor * ( D * V );
}
#endif
float IBLSheenBRDF( const in vec3 normal, const in vec3 viewDir, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	float r2 = roughness * roughness;
	float rInv = 1.0 / ( roughness + 0.1 );
	float a = -1.9362 + 1.0678 * roughness + 0.4573 * r2 - 0.8469 * rInv;
	float b = -0.6014 + 0.5538 * roughness - 0.4670 * r2 - 0.1255 * rInv;
	float DG = exp( a * dotNV + b );
	return saturate( DG );
}
vec3 EnvironmentBRDF( const in vec3 normal, const in vec3 viewDir, const in vec3 specularColor, const in float specularF90, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	vec2 fab = texture2D( dfgLUT, vec2( roughness, dotNV ) ).rg;
	return specularColor * fab.x + specularF90 * fab.y;
}
#ifdef USE_IRIDESCENCE
void computeMultiscatteringIridescence( const in vec2 fab, const in vec3 specularColor, const in float specularF90, const in float iridescence, const in vec3 iridescenceF0, inout vec3 singleScatter, inout vec3 multiScatter ) {
#else
void computeMultiscattering( const in vec2 fab, const in vec3 specularColor, const in float specularF90, inout vec3 singleScatter, inout vec3 multiScatter ) {
#endif
	#ifdef USE_IRIDESCENCE
		vec3 Fr = mix( specularColor, iridescenceF0, iridescence );
	#else
		vec3 Fr = specularColor;
	#endif
	vec3 FssEss = Fr * fab.x + specularF90 * fab.y;
	float Ess = fab.x + fab.y;
	float Ems = 1.0 - Ess;
	vec3 Favg = Fr + ( 1.0 - Fr ) * 0.047619;	vec3 Fms = FssEss * Favg / ( 1.0 - Ems * Favg );
	singleScatter += FssEss;
	multiScatter += Fms * Ems;
}
#if NUM_RECT_AREA_LIGHTS > 0
	void RE_Direct_RectArea_Physical( const in RectAreaLight rectAreaLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
		vec3 normal = geometryNormal;
		vec3 viewDir = geometryViewDir;
		vec3 position = geometryPosition;
		vec3 lightPos = rectAreaLight.position;
		vec3 halfWidth = rectAreaLight.halfWidth;
		vec3 halfHeight = rectAreaLight.halfHeight;
		vec3 lightColor = rectAreaLight.color;
		float roughness = material.roughness;
		vec3 rectCoords[ 4 ];
		rectCoords[ 0 ] = lightPos + halfWidth - halfHeight;		rectCoords[ 1 ] = lightPos - halfWidth - halfHeight;
		rectCoords[ 2 ] = lightPos - halfWidth + halfHeight;
		rectCoords[ 3 ] = lightPos + halfWidth + halfHeight;
		vec2 uv = LTC_Uv( normal, viewDir, roughness );
		vec4 t1 = texture2D( ltc_1, uv );
		vec4 t2 = texture2D( ltc_2, uv );
		mat3 mInv = mat3(
			vec3( t1.x, 0, t1.y ),
			vec3(    0, 1,    0 ),
			vec3( t1.z, 0, t1.w )
		);
		vec3 fresnel = ( material.specularColorBlended * t2.x + ( material.specularF90 - material.specularColorBlended ) * t2.y );
		reflectedLight.directSpecular += lightColor * fresnel * LTC_Evaluate( normal, viewDir, position, mInv, rectCoords );
		reflectedLight.directDiffuse += lightColor * material.diffuseContribution * LTC_Evaluate( normal, viewDir, position, mat3( 1.0 ), rectCoords );
		#ifdef USE_CLEARCOAT
			vec3 Ncc = geometryClearcoatNormal;
			vec2 uvClearcoat = LTC_Uv( Ncc, viewDir, material.clearcoatRoughness );
			vec4 t1Clearcoat = texture2D( ltc_1, uvClearcoat );
			vec4 t2Clearcoat = texture2D( ltc_2, uvClearcoat );
			mat3 mInvClearcoat = mat3(
				vec3( t1Clearcoat.x, 0, t1Clearcoat.y ),
				vec3(             0, 1,             0 ),
				vec3( t1Clearcoat.z, 0, t1Clearcoat.w )
			);
			vec3 fresnelClearcoat = material.clearcoatF0 * t2Clearcoat.x + ( material.clearcoatF90 - material.clearcoatF0 ) * t2Clearcoat.y;
			clearcoatSpecularDirect += lightColor * fresnelClearcoat * LTC_Evaluate( Ncc, viewDir, position, mInvClearcoat, rectCoords );
		#endif
	}
#endif
void RE_Direct_Physical( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	#ifdef USE_CLEARCOAT
		float dotNLcc = saturate( dot( geometryClearcoatNormal, directLight.direction ) );
		vec3 ccIrradiance = dotNLcc * directLight.color;
		clearcoatSpecularDirect += ccIrradiance * BRDF_GGX_Clearcoat( directLight.direction, geometryViewDir, geometryClearcoatNormal, material );
	#endif
	#ifdef USE_SHEEN
 
 		sheenSpecularDirect += irradiance * BRDF_Sheen( directLight.direction, geometryViewDir, geometryNormal, material.sheenColor, material.sheenRoughness );
 
 		float sheenAlbedoV = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
 		float sheenAlbedoL = IBLSheenBRDF( geometryNormal, directLight.direction, material.sheenRoughness );
 
 		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * max( sheenAlbedoV, sheenAlbedoL );
 
 		irradiance *= sheenEnergyComp;
 
 	#endif
	vec3 specularBRDF = BRDF_GGX( directLight.direction, geometryViewDir, geometryNormal, material );
	#ifdef USE_RETROREFLECTION
		vec3 retroViewDir = reflect( - geometryViewDir, geometryNormal );
		vec3 retroSpecularBRDF = BRDF_GGX( directLight.direction, retroViewDir, geometryNormal, material );
		specularBRDF = mix( specularBRDF, retroSpecularBRDF, saturate( material.retroreflectivity ) );
	#endif
	reflectedLight.directSpecular += irradiance * specularBRDF * material.multiScatteringCompensation;
	vec3 halfDir = normalize( directLight.direction + geometryViewDir );
	float dotVH = saturate( dot( geometryViewDir, halfDir ) );
	vec3 F = F_Schlick( material.specularColor, material.specularF90, dotVH );
	#ifdef USE_RETROREFLECTION
		vec3 retroHalfDir = normalize( directLight.direction + retroViewDir );
		float dotRetroVH = saturate( dot( retroViewDir, retroHalfDir ) );
		vec3 retroF = F_Schlick( material.specularColor, material.specularF90, dotRetroVH );
		F = mix( F, retroF, saturate( material.retroreflectivity ) );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		vec3 diffuseBRDF = BRDF_EON( directLight.direction, geometryViewDir, geometryNormal, material.diffuseColor, material.diffuseRoughness ) * ( 1.0 - material.metalness );
	#else
		vec3 diffuseBRDF = BRDF_Lambert( material.diffuseContribution );
	#endif
	reflectedLight.directDiffuse += irradiance * diffuseBRDF * ( 1.0 - F );
}
void RE_IndirectDiffuse_Physical( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 singleScattering = vec3( 0.0 );
	vec3 multiScattering = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScattering, multiScattering );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScattering, multiScattering );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuseAlbedo = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness );
		vec3 diffuse = irradiance * RECIPROCAL_PI * diffuseAlbedo * ( 1.0 - singleScattering - multiScattering );
	#else
		vec3 diffuse = irradiance * BRDF_Lambert( material.diffuseContribution ) * ( 1.0 - singleScattering - multiScattering );
	#endif
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		sheenSpecularIndirect += irradiance * material.sheenColor * sheenAlbedo * RECIPROCAL_PI;
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		diffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectDiffuse += diffuse;
}
void RE_IndirectSpecular_Physical( const in vec3 radiance, const in vec3 irradiance, const in vec3 clearcoatRadiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight) {
	#ifdef USE_CLEARCOAT
		clearcoatSpecularIndirect += clearcoatRadiance * EnvironmentBRDF( geometryClearcoatNormal, geometryViewDir, material.clearcoatF0, material.clearcoatF90, material.clearcoatRoughness );
	#endif
	#ifdef USE_SHEEN
		sheenSpecularIndirect += irradiance * material.sheenColor * IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness ) * RECIPROCAL_PI;
 	#endif
	vec3 singleScatteringDielectric = vec3( 0.0 );
	vec3 multiScatteringDielectric = vec3( 0.0 );
	vec3 singleScatteringMetallic = vec3( 0.0 );
	vec3 multiScatteringMetallic = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscatteringIridescence( material.dfg, material.diffuseColor, material.specularF90, material.iridescence, material.iridescenceF0Metallic, singleScatteringMetallic, multiScatteringMetallic );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscattering( material.dfg, material.diffuseColor, material.specularF90, singleScatteringMetallic, multiScatteringMetallic );
	#endif
	vec3 singleScattering = mix( singleScatteringDielectric, singleScatteringMetallic, material.metalness );
	vec3 multiScattering = mix( multiScatteringDielectric, multiScatteringMetallic, material.metalness );
	vec3 totalScatteringDielectric = singleScatteringDielectric + multiScatteringDielectric;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuse = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness ) * ( 1.0 - totalScatteringDielectric );
	#else
		vec3 diffuse = material.diffuseContribution * ( 1.0 - totalScatteringDielectric );
	#endif
	vec3 cosineWeightedIrradiance = irradiance * RECIPROCAL_PI;
	vec3 indirectSpecular = radiance * singleScattering;
	indirectSpecular += multiScattering * cosineWeightedIrradiance;
	vec3 indirectDiffuse = diffuse * cosineWeightedIrradiance;
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		indirectSpecular *= sheenEnergyComp;
		indirectDiffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectSpecular += indirectSpecular;
	reflectedLight.indirectDiffuse += indirectDiffuse;
}
#define RE_Direct				RE_Direct_Physical
#define RE_Direct_RectArea		RE_Direct_RectArea_Physical
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Physical
#define RE_IndirectSpecular		RE_IndirectSpecular_Physical
float computeSpecularOcclusion( const in float dotNV, const in float ambientOcclusion, const in float roughness ) {
	return saturate( pow( dotNV + ambientOcclusion, exp2( - 16.0 * roughness - 1.0 ) ) - 1.0 + ambientOcclusion );
}`,KS=`
vec3 geometryPosition = - vViewPosition;
vec3 geometryNormal = normal;
vec3 geometryViewDir = ( isOrthographic ) ? vec3( 0, 0, 1 ) : normalize( vViewPosition );
vec3 geometryClearcoatNormal = vec3( 0.0 );
#ifdef USE_CLEARCOAT
	geometryClearcoatNormal = clearcoatNormal;
#endif
#ifdef USE_IRIDESCENCE
	float dotNVi = saturate( dot( normal, geometryViewDir ) );
	if ( material.iridescenceThickness == 0.0 ) {
		material.iridescence = 0.0;
	} else {
		material.iridescence = saturate( material.iridescence );
	}
	if ( material.iridescence > 0.0 ) {
		vec3 iridescenceFresnelDielectric = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.specularColor );
		vec3 iridescenceFresnelMetallic = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.diffuseColor );
		material.iridescenceFresnel = mix( iridescenceFresnelDielectric, iridescenceFresnelMetallic, material.metalness );
		material.iridescenceF0Dielectric = Schlick_to_F0( iridescenceFresnelDielectric, 1.0, dotNVi );
		material.iridescenceF0Metallic = Schlick_to_F0( iridescenceFresnelMetallic, 1.0, dotNVi );
	}
#endif
#ifdef STANDARD
	float dotNVms = saturate( dot( geometryNormal, geometryViewDir ) );
	material.dfg = texture2D( dfgLUT, vec2( material.roughness, dotNVms ) ).rg;
	#if ( NUM_SUN_LIGHTS > 0 || NUM_DIR_LIGHTS > 0 || NUM_POINT_LIGHTS > 0 || NUM_SPOT_LIGHTS > 0 )
		float EssMs = material.dfg.x + material.dfg.y;
		material.multiScatteringCompensation = 1.0 + material.specularColorBlended * ( 1.0 / EssMs - 1.0 );
	#endif
#endif
IncidentLight directLight;
#if ( NUM_POINT_LIGHTS > 0 ) && defined( RE_Direct )
	PointLight pointLight;
	#if defined( USE_SHADOWMAP ) && NUM_POINT_LIGHT_SHADOWS > 0
	PointLightShadow pointLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHTS; i ++ ) {
		pointLight = pointLights[ i ];
		getPointLightInfo( pointLight, geometryPosition, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_POINT_LIGHT_SHADOWS ) && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
		pointLightShadow = pointLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getPointShadow( pointShadowMap[ i ], pointLightShadow.shadowMapSize, pointLightShadow.shadowIntensity, pointLightShadow.shadowBias, pointLightShadow.shadowRadius, vPointShadowCoord[ i ], pointLightShadow.shadowCameraNear, pointLightShadow.shadowCameraFar ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SPOT_LIGHTS > 0 ) && defined( RE_Direct )
	SpotLight spotLight;
	vec4 spotColor;
	vec3 spotLightCoord;
	bool inSpotLightMap;
	#if defined( USE_SHADOWMAP ) && NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHTS; i ++ ) {
		spotLight = spotLights[ i ];
		getSpotLightInfo( spotLight, geometryPosition, directLight );
		#if ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#define SPOT_LIGHT_MAP_INDEX UNROLLED_LOOP_INDEX
		#elif ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		#define SPOT_LIGHT_MAP_INDEX NUM_SPOT_LIGHT_MAPS
		#else
		#define SPOT_LIGHT_MAP_INDEX ( UNROLLED_LOOP_INDEX - NUM_SPOT_LIGHT_SHADOWS + NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#endif
		#if ( SPOT_LIGHT_MAP_INDEX < NUM_SPOT_LIGHT_MAPS )
			spotLightCoord = vSpotLightCoord[ i ].xyz / vSpotLightCoord[ i ].w;
			inSpotLightMap = all( lessThan( abs( spotLightCoord * 2. - 1. ), vec3( 1.0 ) ) );
			spotColor = texture2D( spotLightMap[ SPOT_LIGHT_MAP_INDEX ], spotLightCoord.xy );
			directLight.color = inSpotLightMap ? directLight.color * spotColor.rgb : directLight.color;
		#endif
		#undef SPOT_LIGHT_MAP_INDEX
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		spotLightShadow = spotLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( spotShadowMap[ i ], spotLightShadow.shadowMapSize, spotLightShadow.shadowIntensity, spotLightShadow.shadowBias, spotLightShadow.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SUN_LIGHTS > 0 ) && defined( RE_Direct )
	SunLight sunLight;
	#if defined( USE_SHADOWMAP ) && NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHTS; i ++ ) {
		sunLight = sunLights[ i ];
		getSunLightInfo( sunLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SUN_LIGHT_SHADOWS )
		sunLightShadow = sunLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getSunShadow( sunShadowMap[ i ], sunLightShadow, UNROLLED_LOOP_INDEX ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_DIR_LIGHTS > 0 ) && defined( RE_Direct )
	DirectionalLight directionalLight;
	#if defined( USE_SHADOWMAP ) && NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHTS; i ++ ) {
		directionalLight = directionalLights[ i ];
		getDirectionalLightInfo( directionalLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_DIR_LIGHT_SHADOWS )
		directionalLightShadow = directionalLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( directionalShadowMap[ i ], directionalLightShadow.shadowMapSize, directionalLightShadow.shadowIntensity, directionalLightShadow.shadowBias, directionalLightShadow.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_RECT_AREA_LIGHTS > 0 ) && defined( RE_Direct_RectArea )
	RectAreaLight rectAreaLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_RECT_AREA_LIGHTS; i ++ ) {
		rectAreaLight = rectAreaLights[ i ];
		RE_Direct_RectArea( rectAreaLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if defined( RE_IndirectDiffuse )
	vec3 iblIrradiance = vec3( 0.0 );
	vec3 irradiance = getAmbientLightIrradiance( ambientLightColor );
	#if defined( USE_LIGHT_PROBES )
		irradiance += getLightProbeIrradiance( lightProbe, geometryNormal );
	#endif
	#if ( NUM_HEMI_LIGHTS > 0 )
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_HEMI_LIGHTS; i ++ ) {
			irradiance += getHemisphereLightIrradiance( hemisphereLights[ i ], geometryNormal );
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_LIGHT_PROBE_GRIDS > 0
		vec3 probeWorldPos = ( ( vec4( geometryPosition, 1.0 ) - viewMatrix[ 3 ] ) * viewMatrix ).xyz;
		vec3 probeWorldNormal = transformNormalByInverseViewMatrix( geometryNormal, viewMatrix );
		int probeGrid = - 1;
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( isInsideLightProbeGrid( probeWorldPos, probeWorldNormal, probesMin[ i ], probesMax[ i ], probesResolution[ i ] ) ) probeGrid = UNROLLED_LOOP_INDEX;
		}
		#pragma unroll_loop_end
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( probeGrid == UNROLLED_LOOP_INDEX ) irradiance += getLightProbeGridIrradiance( probesSH[ i ], probesMin[ i ], probesMax[ i ], probesResolution[ i ], probeWorldPos, probeWorldNormal );
		}
		#pragma unroll_loop_end
	#endif
#endif
#if defined( RE_IndirectSpecular )
	vec3 radiance = vec3( 0.0 );
	vec3 clearcoatRadiance = vec3( 0.0 );
#endif`,JS=`#if defined( RE_IndirectDiffuse )
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		vec3 lightMapIrradiance = lightMapTexel.rgb * lightMapIntensity;
		irradiance += lightMapIrradiance;
	#endif
	#if defined( USE_ENVMAP ) && defined( ENVMAP_TYPE_PMREM )
		#if defined( STANDARD ) || defined( LAMBERT ) || defined( PHONG )
			iblIrradiance += getIBLIrradiance( geometryNormal );
		#endif
	#endif
#endif
#if defined( USE_ENVMAP ) && defined( RE_IndirectSpecular )
	#ifdef USE_ANISOTROPY
		vec3 iblRadiance = getIBLAnisotropyRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
	#else
		vec3 iblRadiance = getIBLRadiance( geometryViewDir, geometryNormal, material.roughness );
	#endif
	#ifdef USE_RETROREFLECTION
		#ifdef USE_ANISOTROPY
			vec3 retroIBLRadiance = getIBLAnisotropyRetroRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
		#else
			vec3 retroIBLRadiance = getIBLRetroRadiance( geometryViewDir, geometryNormal, material.roughness );
		#endif
		iblRadiance = mix( iblRadiance, retroIBLRadiance, saturate( material.retroreflectivity ) );
	#endif
	radiance += iblRadiance;
	#ifdef USE_CLEARCOAT
		clearcoatRadiance += getIBLRadiance( geometryViewDir, geometryClearcoatNormal, material.clearcoatRoughness );
	#endif
#endif`,jS=`#if defined( RE_IndirectDiffuse )
	#if defined( LAMBERT ) || defined( PHONG )
		irradiance += iblIrradiance;
	#endif
	RE_IndirectDiffuse( irradiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif
#if defined( RE_IndirectSpecular )
	RE_IndirectSpecular( radiance, iblIrradiance, clearcoatRadiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif`,QS=`#if NUM_LIGHT_PROBE_GRIDS > 0
uniform highp sampler3D probesSH[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMin[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMax[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesResolution[ NUM_LIGHT_PROBE_GRIDS ];
bool isInsideLightProbeGrid( vec3 worldPos, vec3 worldNormal, vec3 probesMin, vec3 probesMax, vec3 probesResolution ) {
	vec3 spacing = ( probesMax - probesMin ) / probesResolution;
	vec3 samplePos = worldPos + worldNormal * spacing * 0.5;
	vec3 margin = spacing * 0.01;
	return all( greaterThanEqual( samplePos, probesMin - margin ) ) && all( lessThanEqual( samplePos, probesMax + margin ) );
}
vec3 getLightProbeGridIrradiance( highp sampler3D probesSH, vec3 probesMin, vec3 probesMax, vec3 probesResolution, vec3 worldPos, vec3 worldNormal ) {
	vec3 res = probesResolution;
	vec3 gridRange = probesMax - probesMin;
	vec3 probeSpacing = gridRange / res;
	vec3 samplePos = worldPos + worldNormal * probeSpacing * 0.5;
	vec3 uvw = clamp( ( samplePos - probesMin ) / gridRange, 0.5 / res, 1.0 - 0.5 / res );
	float nz          = res.z;
	float paddedSlices = nz + 2.0;
	float atlasDepth  = 7.0 * paddedSlices;
	float uvZBase     = uvw.z * nz + 1.0;
	vec4 s0 = texture( probesSH, vec3( uvw.xy, ( uvZBase                       ) / atlasDepth ) );
	vec4 s1 = texture( probesSH, vec3( uvw.xy, ( uvZBase +       paddedSlices   ) / atlasDepth ) );
	vec4 s2 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 2.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s3 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 3.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s4 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 4.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s5 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 5.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s6 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 6.0 * paddedSlices   ) / atlasDepth ) );
	vec3 c0 = s0.xyz;
	vec3 c1 = vec3( s0.w, s1.xy );
	vec3 c2 = vec3( s1.zw, s2.x );
	vec3 c3 = s2.yzw;
	vec3 c4 = s3.xyz;
	vec3 c5 = vec3( s3.w, s4.xy );
	vec3 c6 = vec3( s4.zw, s5.x );
	vec3 c7 = s5.yzw;
	vec3 c8 = s6.xyz;
	float x = worldNormal.x, y = worldNormal.y, z = worldNormal.z;
	vec3 result = c0 * 0.886227;
	result += c1 * 2.0 * 0.511664 * y;
	result += c2 * 2.0 * 0.511664 * z;
	result += c3 * 2.0 * 0.511664 * x;
	result += c4 * 2.0 * 0.429043 * x * y;
	result += c5 * 2.0 * 0.429043 * y * z;
	result += c6 * ( 0.743125 * z * z - 0.247708 );
	result += c7 * 2.0 * 0.429043 * x * z;
	result += c8 * 0.429043 * ( x * x - y * y );
	return max( result, vec3( 0.0 ) );
}
#endif`,tM=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	gl_FragDepth = vIsPerspective == 0.0 ? gl_FragCoord.z : log2( vFragDepth ) * logDepthBufFC * 0.5;
#endif`,eM=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	uniform float logDepthBufFC;
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,nM=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,iM=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	vFragDepth = 1.0 + gl_Position.w;
	vIsPerspective = float( isPerspectiveMatrix( projectionMatrix ) );
#endif`,sM=`#ifdef USE_MAP
	vec4 sampledDiffuseColor = texture2D( map, vMapUv );
	#ifdef DECODE_VIDEO_TEXTURE
		sampledDiffuseColor = sRGBTransferEOTF( sampledDiffuseColor );
	#endif
	diffuseColor *= sampledDiffuseColor;
#endif`,rM=`#ifdef USE_MAP
	uniform sampler2D map;
#endif`,oM=`#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
	#if defined( USE_POINTS_UV )
		vec2 uv = vUv;
	#else
		vec2 uv = ( uvTransform * vec3( gl_PointCoord.x, 1.0 - gl_PointCoord.y, 1 ) ).xy;
	#endif
#endif
#ifdef USE_MAP
	diffuseColor *= texture2D( map, uv );
#endif
#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, uv ).g;
#endif`,aM=`#if defined( USE_POINTS_UV )
	varying vec2 vUv;
#else
	#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
		uniform mat3 uvTransform;
	#endif
#endif
#ifdef USE_MAP
	uniform sampler2D map;
#endif
#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,lM=`float metalnessFactor = metalness;
#ifdef USE_METALNESSMAP
	vec4 texelMetalness = texture2D( metalnessMap, vMetalnessMapUv );
	metalnessFactor *= texelMetalness.b;
#endif`,cM=`#ifdef USE_METALNESSMAP
	uniform sampler2D metalnessMap;
#endif`,hM=`#ifdef USE_INSTANCING_MORPH
	float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	float morphTargetBaseInfluence = texelFetch( morphTexture, ivec2( 0, gl_InstanceID ), 0 ).r;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		morphTargetInfluences[i] =  texelFetch( morphTexture, ivec2( i + 1, gl_InstanceID ), 0 ).r;
	}
#endif`,uM=`#if defined( USE_MORPHCOLORS )
	#if defined( USE_COLOR_ALPHA )
		vColor *= morphTargetBaseInfluence;
	#elif defined( USE_COLOR )
		vColor.rgb *= morphTargetBaseInfluence;
	#endif
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		#if defined( USE_COLOR_ALPHA )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor += getMorph( gl_VertexID, i, 2 ) * morphTargetInfluences[ i ];
		#elif defined( USE_COLOR )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor.rgb += getMorph( gl_VertexID, i, 2 ).rgb * morphTargetInfluences[ i ];
		#endif
	}
#endif`,fM=`#ifdef USE_MORPHNORMALS
	objectNormal *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) objectNormal += getMorph( gl_VertexID, i, 1 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,dM=`#ifdef USE_MORPHTARGETS
	#ifndef USE_INSTANCING_MORPH
		uniform float morphTargetBaseInfluence;
		uniform float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	#endif
	uniform sampler2DArray morphTargetsTexture;
	uniform ivec2 morphTargetsTextureSize;
	vec4 getMorph( const in int vertexIndex, const in int morphTargetIndex, const in int offset ) {
		int texelIndex = vertexIndex * MORPHTARGETS_TEXTURE_STRIDE + offset;
		int y = texelIndex / morphTargetsTextureSize.x;
		int x = texelIndex - y * morphTargetsTextureSize.x;
		ivec3 morphUV = ivec3( x, y, morphTargetIndex );
		return texelFetch( morphTargetsTexture, morphUV, 0 );
	}
#endif`,pM=`#ifdef USE_MORPHTARGETS
	transformed *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) transformed += getMorph( gl_VertexID, i, 0 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,mM=`float faceDirection = gl_FrontFacing ? 1.0 : - 1.0;
#ifdef FLAT_SHADED
	vec3 fdx = dFdx( vViewPosition );
	vec3 fdy = dFdy( vViewPosition );
	vec3 normal = normalize( cross( fdx, fdy ) );
#else
	vec3 normal = normalize( vNormal );
	#ifdef DOUBLE_SIDED
		normal *= faceDirection;
	#endif
#endif
#if defined( USE_NORMALMAP_TANGENTSPACE ) || defined( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY )
	#ifdef USE_TANGENT
		mat3 tbn = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn = getTangentFrame( - vViewPosition, normal,
		#if defined( USE_NORMALMAP )
			vNormalMapUv
		#elif defined( USE_CLEARCOAT_NORMALMAP )
			vClearcoatNormalMapUv
		#else
			vUv
		#endif
		);
	#endif
	#ifdef DOUBLE_SIDED
		tbn[0] *= faceDirection;
		tbn[1] *= faceDirection;
	#endif
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	#ifdef USE_TANGENT
		mat3 tbn2 = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn2 = getTangentFrame( - vViewPosition, normal, vClearcoatNormalMapUv );
	#endif
	#ifdef DOUBLE_SIDED
		tbn2[0] *= faceDirection;
		tbn2[1] *= faceDirection;
	#endif
#endif
vec3 nonPerturbedNormal = normal;`,gM=`#ifdef USE_NORMALMAP_OBJECTSPACE
	normal = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#ifdef FLIP_SIDED
		normal = - normal;
	#endif
	#ifdef DOUBLE_SIDED
		normal = normal * faceDirection;
	#endif
	normal = normalize( normalMatrix * normal );
#elif defined( USE_NORMALMAP_TANGENTSPACE )
	vec3 mapN = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#if defined( USE_PACKED_NORMALMAP )
		mapN = vec3( mapN.xy, sqrt( saturate( 1.0 - dot( mapN.xy, mapN.xy ) ) ) );
	#endif
	mapN.xy *= normalScale;
	normal = normalize( tbn * mapN );
#elif defined( USE_BUMPMAP )
	normal = perturbNormalArb( - vViewPosition, normal, dHdxy_fwd(), faceDirection );
#endif`,_M=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,xM=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,yM=`#ifndef FLAT_SHADED
	vNormal = normalize( transformedNormal );
	#ifdef USE_TANGENT
		vTangent = normalize( transformedTangent );
		vBitangent = normalize( cross( vNormal, vTangent ) * tangent.w );
		#ifdef FLIP_SIDED
			vBitangent = - vBitangent;
		#endif
	#endif
#endif`,vM=`#ifdef USE_NORMALMAP
	uniform sampler2D normalMap;
	uniform vec2 normalScale;
#endif
#ifdef USE_NORMALMAP_OBJECTSPACE
	uniform mat3 normalMatrix;
#endif
#if ! defined ( USE_TANGENT ) && ( defined ( USE_NORMALMAP_TANGENTSPACE ) || defined ( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY ) )
	mat3 getTangentFrame( vec3 eye_pos, vec3 surf_norm, vec2 uv ) {
		vec3 q0 = dFdx( eye_pos.xyz );
		vec3 q1 = dFdy( eye_pos.xyz );
		vec2 st0 = dFdx( uv.st );
		vec2 st1 = dFdy( uv.st );
		vec3 N = surf_norm;
		vec3 q1perp = cross( q1, N );
		vec3 q0perp = cross( N, q0 );
		vec3 T = q1perp * st0.x + q0perp * st1.x;
		vec3 B = q1perp * st0.y + q0perp * st1.y;
		float det = max( dot( T, T ), dot( B, B ) );
		float scale = ( det == 0.0 ) ? 0.0 : inversesqrt( det );
		return mat3( T * scale, B * scale, N );
	}
#endif`,SM=`#ifdef USE_CLEARCOAT
	vec3 clearcoatNormal = nonPerturbedNormal;
#endif`,MM=`#ifdef USE_CLEARCOAT_NORMALMAP
	vec3 clearcoatMapN = texture2D( clearcoatNormalMap, vClearcoatNormalMapUv ).xyz * 2.0 - 1.0;
	clearcoatMapN.xy *= clearcoatNormalScale;
	clearcoatNormal = normalize( tbn2 * clearcoatMapN );
#endif`,bM=`#ifdef USE_CLEARCOATMAP
	uniform sampler2D clearcoatMap;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform sampler2D clearcoatNormalMap;
	uniform vec2 clearcoatNormalScale;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform sampler2D clearcoatRoughnessMap;
#endif`,wM=`#ifdef USE_IRIDESCENCEMAP
	uniform sampler2D iridescenceMap;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform sampler2D iridescenceThicknessMap;
#endif`,TM=`#ifdef OPAQUE
diffuseColor.a = 1.0;
#endif
#ifdef USE_TRANSMISSION
diffuseColor.a *= material.transmissionAlpha;
#endif
gl_FragColor = vec4( outgoingLight, diffuseColor.a );`,AM=`vec3 packNormalToRGB( const in vec3 normal ) {
	return normalize( normal ) * 0.5 + 0.5;
}
vec3 unpackRGBToNormal( const in vec3 rgb ) {
	return 2.0 * rgb.xyz - 1.0;
}
const float PackUpscale = 256. / 255.;const float UnpackDownscale = 255. / 256.;const float ShiftRight8 = 1. / 256.;
const float Inv255 = 1. / 255.;
const vec4 PackFactors = vec4( 1.0, 256.0, 256.0 * 256.0, 256.0 * 256.0 * 256.0 );
const vec2 UnpackFactors2 = vec2( UnpackDownscale, 1.0 / PackFactors.g );
const vec3 UnpackFactors3 = vec3( UnpackDownscale / PackFactors.rg, 1.0 / PackFactors.b );
const vec4 UnpackFactors4 = vec4( UnpackDownscale / PackFactors.rgb, 1.0 / PackFactors.a );
vec4 packDepthToRGBA( const in float v ) {
	if( v <= 0.0 )
		return vec4( 0., 0., 0., 0. );
	if( v >= 1.0 )
		return vec4( 1., 1., 1., 1. );
	float vuf;
	float af = modf( v * PackFactors.a, vuf );
	float bf = modf( vuf * ShiftRight8, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec4( vuf * Inv255, gf * PackUpscale, bf * PackUpscale, af );
}
vec3 packDepthToRGB( const in float v ) {
	if( v <= 0.0 )
		return vec3( 0., 0., 0. );
	if( v >= 1.0 )
		return vec3( 1., 1., 1. );
	float vuf;
	float bf = modf( v * PackFactors.b, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec3( vuf * Inv255, gf * PackUpscale, bf );
}
vec2 packDepthToRG( const in float v ) {
	if( v <= 0.0 )
		return vec2( 0., 0. );
	if( v >= 1.0 )
		return vec2( 1., 1. );
	float vuf;
	float gf = modf( v * 256., vuf );
	return vec2( vuf * Inv255, gf );
}
float unpackRGBAToDepth( const in vec4 v ) {
	return dot( v, UnpackFactors4 );
}
float unpackRGBToDepth( const in vec3 v ) {
	return dot( v, UnpackFactors3 );
}
float unpackRGToDepth( const in vec2 v ) {
	return v.r * UnpackFactors2.r + v.g * UnpackFactors2.g;
}
vec4 pack2HalfToRGBA( const in vec2 v ) {
	vec4 r = vec4( v.x, fract( v.x * 255.0 ), v.y, fract( v.y * 255.0 ) );
	return vec4( r.x - r.y / 255.0, r.y, r.z - r.w / 255.0, r.w );
}
vec2 unpackRGBATo2Half( const in vec4 v ) {
	return vec2( v.x + ( v.y / 255.0 ), v.z + ( v.w / 255.0 ) );
}
float viewZToOrthographicDepth( const in float viewZ, const in float near, const in float far ) {
	return ( viewZ + near ) / ( near - far );
}
float orthographicDepthToViewZ( const in float depth, const in float near, const in float far ) {
	#ifdef USE_REVERSED_DEPTH_BUFFER
	
		return depth * ( far - near ) - far;
	#else
		return depth * ( near - far ) - near;
	#endif
}
float viewZToPerspectiveDepth( const in float viewZ, const in float near, const in float far ) {
	return ( ( near + viewZ ) * far ) / ( ( far - near ) * viewZ );
}
float perspectiveDepthToViewZ( const in float depth, const in float near, const in float far ) {
	
	#ifdef USE_REVERSED_DEPTH_BUFFER
		return ( near * far ) / ( ( near - far ) * depth - near );
	#else
		return ( near * far ) / ( ( far - near ) * depth - far );
	#endif
}`,EM=`#ifdef PREMULTIPLIED_ALPHA
	gl_FragColor.rgb *= gl_FragColor.a;
#endif`,CM=`vec4 mvPosition = vec4( transformed, 1.0 );
#ifdef USE_BATCHING
	mvPosition = batchingMatrix * mvPosition;
#endif
#ifdef USE_INSTANCING
	mvPosition = instanceMatrix * mvPosition;
#endif
mvPosition = modelViewMatrix * mvPosition;
gl_Position = projectionMatrix * mvPosition;`,RM=`#ifdef DITHERING
	gl_FragColor.rgb = dithering( gl_FragColor.rgb );
#endif`,PM=`#ifdef DITHERING
	vec3 dithering( vec3 color ) {
		float grid_position = rand( gl_FragCoord.xy );
		vec3 dither_shift_RGB = vec3( 0.25 / 255.0, -0.25 / 255.0, 0.25 / 255.0 );
		dither_shift_RGB = mix( 2.0 * dither_shift_RGB, -2.0 * dither_shift_RGB, grid_position );
		return color + dither_shift_RGB;
	}
#endif`,IM=`float roughnessFactor = roughness;
#ifdef USE_ROUGHNESSMAP
	vec4 texelRoughness = texture2D( roughnessMap, vRoughnessMapUv );
	roughnessFactor *= texelRoughness.g;
#endif`,LM=`#ifdef USE_ROUGHNESSMAP
	uniform sampler2D roughnessMap;
#endif`,DM=`#if NUM_SPOT_LIGHT_COORDS > 0
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#if NUM_SPOT_LIGHT_MAPS > 0
	uniform sampler2D spotLightMap[ NUM_SPOT_LIGHT_MAPS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		#define SUN_LIGHT_CASCADES 2
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#else
			uniform sampler2D sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#endif
		uniform mat4 sunShadowMatrix[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		uniform vec4 sunShadowCascade[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
		struct SunLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SunLightShadow sunLightShadows[ NUM_SUN_LIGHT_SHADOWS ];
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#else
			uniform sampler2D directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#endif
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#else
			uniform sampler2D spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#endif
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform samplerCubeShadow pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#elif defined( SHADOWMAP_TYPE_BASIC )
			uniform samplerCube pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#endif
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float interleavedGradientNoise( vec2 position ) {
			return fract( 52.9829189 * fract( dot( position, vec2( 0.06711056, 0.00583715 ) ) ) );
		}
		vec2 vogelDiskSample( int sampleIndex, int samplesCount, float phi ) {
			const float goldenAngle = 2.399963229728653;
			float r = sqrt( ( float( sampleIndex ) + 0.5 ) / float( samplesCount ) );
			float theta = float( sampleIndex ) * goldenAngle + phi;
			return vec2( cos( theta ), sin( theta ) ) * r;
		}
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float getShadow( sampler2DShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 texelSize = vec2( 1.0 ) / shadowMapSize;
				vec2 radius = shadowRadius * texelSize;
				float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
				shadow = (
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 0, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 1, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 2, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 3, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 4, 5, phi ) * radius, shadowCoord.z ) )
				) * 0.2;
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#elif defined( SHADOWMAP_TYPE_VSM )
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 distribution = texture2D( shadowMap, shadowCoord.xy ).rg;
				float mean = distribution.x;
				float variance = distribution.y * distribution.y;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					float hard_shadow = step( mean, shadowCoord.z );
				#else
					float hard_shadow = step( shadowCoord.z, mean );
				#endif
				
				if ( hard_shadow == 1.0 ) {
					shadow = 1.0;
				} else {
					variance = max( variance, 0.0000001 );
					float d = shadowCoord.z - mean;
					float p_max = variance / ( variance + d * d );
					p_max = clamp( ( p_max - 0.3 ) / 0.65, 0.0, 1.0 );
					shadow = max( hard_shadow, p_max );
				}
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#else
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				float depth = texture2D( shadowMap, shadowCoord.xy ).r;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					shadow = step( depth, shadowCoord.z );
				#else
					shadow = step( shadowCoord.z, depth );
				#endif
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#endif
	#if NUM_SUN_LIGHT_SHADOWS > 0
		float getSunShadow(
			#if defined( SHADOWMAP_TYPE_PCF )
				sampler2DShadow shadowMap,
			#else
				sampler2D shadowMap,
			#endif
			SunLightShadow sunLightShadow,
			int shadowIndex
		) {
			vec4 shadowWorldPosition = vec4( vSunShadowWorldPosition.xyz + vSunShadowWorldNormal * sunLightShadow.shadowNormalBias, 1.0 );
			float viewDepth = vSunShadowWorldPosition.w;
			int cascadeOffset = shadowIndex * SUN_LIGHT_CASCADES;
			float shadow = 1.0;
			for ( int i = SUN_LIGHT_CASCADES - 1; i >= 0; i -- ) {
				vec4 cascade = sunShadowCascade[ cascadeOffset + i ];
				if ( viewDepth >= cascade.x && viewDepth < cascade.y ) {
					float cascadeShadow = getShadow(
						shadowMap,
						sunLightShadow.shadowMapSize,
						sunLightShadow.shadowIntensity,
						sunLightShadow.shadowBias,
						sunLightShadow.shadowRadius,
						sunShadowMatrix[ cascadeOffset + i ] * shadowWorldPosition
					);
					shadow = mix( cascadeShadow, shadow, smoothstep( cascade.z, cascade.y, viewDepth ) );
				}
			}
			return shadow;
		}
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
	#if defined( SHADOWMAP_TYPE_PCF )
	float getPointShadow( samplerCubeShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 bd3D = normalize( lightToPosition );
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float lightDistance = length( lightToPosition );
			float depthRange = shadowCameraFar - shadowCameraNear;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				float depthA = - shadowCameraNear / depthRange - shadowBias;
				float depthB = shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#else
				float depthA = shadowCameraFar / depthRange + shadowBias;
				float depthB = - shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#endif
			float texelSize = shadowRadius / shadowMapSize.x;
			vec3 absDir = abs( bd3D );
			vec3 tangent = absDir.x > absDir.z ? vec3( 0.0, 1.0, 0.0 ) : vec3( 1.0, 0.0, 0.0 );
			tangent = normalize( cross( bd3D, tangent ) );
			vec3 bitangent = cross( bd3D, tangent );
			float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
			shadow = 0.0;
			for ( int i = 0; i < 5; i ++ ) {
				vec2 offset = vogelDiskSample( i, 5, phi );
				vec3 direction = bd3D + ( tangent * offset.x + bitangent * offset.y ) * texelSize;
				vec3 absDirection = abs( direction );
				float dp = depthA + depthB / max( max( absDirection.x, absDirection.y ), absDirection.z );
				shadow += texture( shadowMap, vec4( direction, dp ) );
			}
			shadow *= 0.2;
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#elif defined( SHADOWMAP_TYPE_BASIC )
	float getPointShadow( samplerCube shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float dp = ( shadowCameraFar * ( viewSpaceZ - shadowCameraNear ) ) / ( viewSpaceZ * ( shadowCameraFar - shadowCameraNear ) );
			dp += shadowBias;
			vec3 bd3D = normalize( lightToPosition );
			float depth = textureCube( shadowMap, bd3D ).r;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				depth = 1.0 - depth;
			#endif
			shadow = step( dp, depth );
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#endif
	#endif
#endif`,NM=`#if NUM_SPOT_LIGHT_COORDS > 0
	uniform mat4 spotLightMatrix[ NUM_SPOT_LIGHT_COORDS ];
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		uniform mat4 directionalShadowMatrix[ NUM_DIR_LIGHT_SHADOWS ];
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		uniform mat4 pointShadowMatrix[ NUM_POINT_LIGHT_SHADOWS ];
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
#endif`,UM=`#if ( defined( USE_SHADOWMAP ) && ( NUM_DIR_LIGHT_SHADOWS > 0 || NUM_SUN_LIGHT_SHADOWS > 0 || NUM_POINT_LIGHT_SHADOWS > 0 ) ) || ( NUM_SPOT_LIGHT_COORDS > 0 )
	#ifdef HAS_NORMAL
		vec3 shadowWorldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
	#else
		vec3 shadowWorldNormal = vec3( 0.0 );
	#endif
	vec4 shadowWorldPosition;
#endif
#if defined( USE_SHADOWMAP )
	#if NUM_SUN_LIGHT_SHADOWS > 0
		vSunShadowWorldPosition = vec4( worldPosition.xyz, - mvPosition.z );
		vSunShadowWorldNormal = shadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * directionalLightShadows[ i ].shadowNormalBias, 0 );
			vDirectionalShadowCoord[ i ] = directionalShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * pointLightShadows[ i ].shadowNormalBias, 0 );
			vPointShadowCoord[ i ] = pointShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
#endif
#if NUM_SPOT_LIGHT_COORDS > 0
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_COORDS; i ++ ) {
		shadowWorldPosition = worldPosition;
		#if ( defined( USE_SHADOWMAP ) && UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
			shadowWorldPosition.xyz += shadowWorldNormal * spotLightShadows[ i ].shadowNormalBias;
		#endif
		vSpotLightCoord[ i ] = spotLightMatrix[ i ] * shadowWorldPosition;
	}
	#pragma unroll_loop_end
#endif`,FM=`float getShadowMask() {
	float shadow = 1.0;
	#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHT_SHADOWS; i ++ ) {
		sunLight = sunLightShadows[ i ];
		shadow *= receiveShadow ? getSunShadow( sunShadowMap[ i ], sunLight, UNROLLED_LOOP_INDEX ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
		directionalLight = directionalLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( directionalShadowMap[ i ], directionalLight.shadowMapSize, directionalLight.shadowIntensity, directionalLight.shadowBias, directionalLight.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_SHADOWS; i ++ ) {
		spotLight = spotLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( spotShadowMap[ i ], spotLight.shadowMapSize, spotLight.shadowIntensity, spotLight.shadowBias, spotLight.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0 && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
	PointLightShadow pointLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
		pointLight = pointLightShadows[ i ];
		shadow *= receiveShadow ? getPointShadow( pointShadowMap[ i ], pointLight.shadowMapSize, pointLight.shadowIntensity, pointLight.shadowBias, pointLight.shadowRadius, vPointShadowCoord[ i ], pointLight.shadowCameraNear, pointLight.shadowCameraFar ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#endif
	return shadow;
}`,OM=`#ifdef USE_SKINNING
	mat4 boneMatX = getBoneMatrix( skinIndex.x );
	mat4 boneMatY = getBoneMatrix( skinIndex.y );
	mat4 boneMatZ = getBoneMatrix( skinIndex.z );
	mat4 boneMatW = getBoneMatrix( skinIndex.w );
#endif`,BM=`#ifdef USE_SKINNING
	uniform mat4 bindMatrix;
	uniform mat4 bindMatrixInverse;
	uniform highp sampler2D boneTexture;
	mat4 getBoneMatrix( const in float i ) {
		int size = textureSize( boneTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( boneTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( boneTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( boneTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( boneTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
#endif`,zM=`#ifdef USE_SKINNING
	vec4 skinVertex = bindMatrix * vec4( transformed, 1.0 );
	vec4 skinned = vec4( 0.0 );
	skinned += boneMatX * skinVertex * skinWeight.x;
	skinned += boneMatY * skinVertex * skinWeight.y;
	skinned += boneMatZ * skinVertex * skinWeight.z;
	skinned += boneMatW * skinVertex * skinWeight.w;
	transformed = ( bindMatrixInverse * skinned ).xyz;
#endif`,kM=`#ifdef USE_SKINNING
	mat4 skinMatrix = mat4( 0.0 );
	skinMatrix += skinWeight.x * boneMatX;
	skinMatrix += skinWeight.y * boneMatY;
	skinMatrix += skinWeight.z * boneMatZ;
	skinMatrix += skinWeight.w * boneMatW;
	skinMatrix = bindMatrixInverse * skinMatrix * bindMatrix;
	objectNormal = vec4( skinMatrix * vec4( objectNormal, 0.0 ) ).xyz;
	#ifdef USE_TANGENT
		objectTangent = vec4( skinMatrix * vec4( objectTangent, 0.0 ) ).xyz;
	#endif
#endif`,VM=`float specularStrength;
#ifdef USE_SPECULARMAP
	vec4 texelSpecular = texture2D( specularMap, vSpecularMapUv );
	specularStrength = texelSpecular.r;
#else
	specularStrength = 1.0;
#endif`,GM=`#ifdef USE_SPECULARMAP
	uniform sampler2D specularMap;
#endif`,HM=`#if defined( TONE_MAPPING )
	gl_FragColor.rgb = toneMapping( gl_FragColor.rgb );
#endif`,WM=`#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
uniform float toneMappingExposure;
vec3 LinearToneMapping( vec3 color ) {
	return saturate( toneMappingExposure * color );
}
vec3 ReinhardToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	return saturate( color / ( vec3( 1.0 ) + color ) );
}
vec3 CineonToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	color = max( vec3( 0.0 ), color - 0.004 );
	return pow( ( color * ( 6.2 * color + 0.5 ) ) / ( color * ( 6.2 * color + 1.7 ) + 0.06 ), vec3( 2.2 ) );
}
vec3 RRTAndODTFit( vec3 v ) {
	vec3 a = v * ( v + 0.0245786 ) - 0.000090537;
	vec3 b = v * ( 0.983729 * v + 0.4329510 ) + 0.238081;
	return a / b;
}
vec3 ACESFilmicToneMapping( vec3 color ) {
	const mat3 ACESInputMat = mat3(
		vec3( 0.59719, 0.07600, 0.02840 ),		vec3( 0.35458, 0.90834, 0.13383 ),
		vec3( 0.04823, 0.01566, 0.83777 )
	);
	const mat3 ACESOutputMat = mat3(
		vec3(  1.60475, -0.10208, -0.00327 ),		vec3( -0.53108,  1.10813, -0.07276 ),
		vec3( -0.07367, -0.00605,  1.07602 )
	);
	color *= toneMappingExposure / 0.6;
	color = ACESInputMat * color;
	color = RRTAndODTFit( color );
	color = ACESOutputMat * color;
	return saturate( color );
}
const mat3 LINEAR_REC2020_TO_LINEAR_SRGB = mat3(
	vec3( 1.6605, - 0.1246, - 0.0182 ),
	vec3( - 0.5876, 1.1329, - 0.1006 ),
	vec3( - 0.0728, - 0.0083, 1.1187 )
);
const mat3 LINEAR_SRGB_TO_LINEAR_REC2020 = mat3(
	vec3( 0.6274, 0.0691, 0.0164 ),
	vec3( 0.3293, 0.9195, 0.0880 ),
	vec3( 0.0433, 0.0113, 0.8956 )
);
vec3 agxDefaultContrastApprox( vec3 x ) {
	vec3 x2 = x * x;
	vec3 x4 = x2 * x2;
	return + 15.5 * x4 * x2
		- 40.14 * x4 * x
		+ 31.96 * x4
		- 6.868 * x2 * x
		+ 0.4298 * x2
		+ 0.1191 * x
		- 0.00232;
}
vec3 AgXToneMapping( vec3 color ) {
	const mat3 AgXInsetMatrix = mat3(
		vec3( 0.856627153315983, 0.137318972929847, 0.11189821299995 ),
		vec3( 0.0951212405381588, 0.761241990602591, 0.0767994186031903 ),
		vec3( 0.0482516061458583, 0.101439036467562, 0.811302368396859 )
	);
	const mat3 AgXOutsetMatrix = mat3(
		vec3( 1.1271005818144368, - 0.1413297634984383, - 0.14132976349843826 ),
		vec3( - 0.11060664309660323, 1.157823702216272, - 0.11060664309660294 ),
		vec3( - 0.016493938717834573, - 0.016493938717834257, 1.2519364065950405 )
	);
	const float AgxMinEv = - 12.47393;	const float AgxMaxEv = 4.026069;
	color *= toneMappingExposure;
	color = LINEAR_SRGB_TO_LINEAR_REC2020 * color;
	color = AgXInsetMatrix * color;
	color = max( color, 1e-10 );	color = log2( color );
	color = ( color - AgxMinEv ) / ( AgxMaxEv - AgxMinEv );
	color = clamp( color, 0.0, 1.0 );
	color = agxDefaultContrastApprox( color );
	color = AgXOutsetMatrix * color;
	color = pow( max( vec3( 0.0 ), color ), vec3( 2.2 ) );
	color = LINEAR_REC2020_TO_LINEAR_SRGB * color;
	color = clamp( color, 0.0, 1.0 );
	return color;
}
vec3 NeutralToneMapping( vec3 color ) {
	const float StartCompression = 0.8 - 0.04;
	const float Desaturation = 0.15;
	color *= toneMappingExposure;
	float x = min( color.r, min( color.g, color.b ) );
	float offset = x < 0.08 ? x - 6.25 * x * x : 0.04;
	color -= offset;
	float peak = max( color.r, max( color.g, color.b ) );
	if ( peak < StartCompression ) return color;
	float d = 1. - StartCompression;
	float newPeak = 1. - d * d / ( peak + d - StartCompression );
	color *= newPeak / peak;
	float g = 1. - 1. / ( Desaturation * ( peak - newPeak ) + 1. );
	return mix( color, vec3( newPeak ), g );
}
vec3 CustomToneMapping( vec3 color ) { return color; }`,XM=`#ifdef USE_TRANSMISSION
	material.transmission = transmission;
	material.transmissionAlpha = 1.0;
	material.thickness = thickness;
	material.attenuationDistance = attenuationDistance;
	material.attenuationColor = attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		material.transmission *= texture2D( transmissionMap, vTransmissionMapUv ).r;
	#endif
	#ifdef USE_THICKNESSMAP
		material.thickness *= texture2D( thicknessMap, vThicknessMapUv ).g;
	#endif
	vec3 pos = vWorldPosition;
	vec3 v = normalize( cameraPosition - pos );
	vec3 n = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec4 transmitted = getIBLVolumeRefraction(
		n, v, material.roughness, material.diffuseContribution, material.specularColorBlended, material.specularF90,
		pos, modelMatrix, viewMatrix, projectionMatrix, material.dispersion, material.ior, material.thickness,
		material.attenuationColor, material.attenuationDistance );
	material.transmissionAlpha = mix( material.transmissionAlpha, transmitted.a, material.transmission );
	totalDiffuse = mix( totalDiffuse, transmitted.rgb, material.transmission );
#endif`,qM=`#ifdef USE_TRANSMISSION
	uniform float transmission;
	uniform float thickness;
	uniform float attenuationDistance;
	uniform vec3 attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		uniform sampler2D transmissionMap;
	#endif
	#ifdef USE_THICKNESSMAP
		uniform sampler2D thicknessMap;
	#endif
	uniform vec2 transmissionSamplerSize;
	uniform sampler2D transmissionSamplerMap;
	uniform mat4 modelMatrix;
	uniform mat4 projectionMatrix;
	varying vec3 vWorldPosition;
	float w0( float a ) {
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - a + 3.0 ) - 3.0 ) + 1.0 );
	}
	float w1( float a ) {
		return ( 1.0 / 6.0 ) * ( a *  a * ( 3.0 * a - 6.0 ) + 4.0 );
	}
	float w2( float a ){
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - 3.0 * a + 3.0 ) + 3.0 ) + 1.0 );
	}
	float w3( float a ) {
		return ( 1.0 / 6.0 ) * ( a * a * a );
	}
	float g0( float a ) {
		return w0( a ) + w1( a );
	}
	float g1( float a ) {
		return w2( a ) + w3( a );
	}
	float h0( float a ) {
		return - 1.0 + w1( a ) / ( w0( a ) + w1( a ) );
	}
	float h1( float a ) {
		return 1.0 + w3( a ) / ( w2( a ) + w3( a ) );
	}
	vec4 bicubic( sampler2D tex, vec2 uv, vec4 texelSize, float lod ) {
		uv = uv * texelSize.zw + 0.5;
		vec2 iuv = floor( uv );
		vec2 fuv = fract( uv );
		float g0x = g0( fuv.x );
		float g1x = g1( fuv.x );
		float h0x = h0( fuv.x );
		float h1x = h1( fuv.x );
		float h0y = h0( fuv.y );
		float h1y = h1( fuv.y );
		vec2 p0 = ( vec2( iuv.x + h0x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p1 = ( vec2( iuv.x + h1x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p2 = ( vec2( iuv.x + h0x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		vec2 p3 = ( vec2( iuv.x + h1x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		return g0( fuv.y ) * ( g0x * textureLod( tex, p0, lod ) + g1x * textureLod( tex, p1, lod ) ) +
			g1( fuv.y ) * ( g0x * textureLod( tex, p2, lod ) + g1x * textureLod( tex, p3, lod ) );
	}
	vec4 textureBicubic( sampler2D sampler, vec2 uv, float lod ) {
		vec2 fLodSize = vec2( textureSize( sampler, int( lod ) ) );
		vec2 cLodSize = vec2( textureSize( sampler, int( lod + 1.0 ) ) );
		vec2 fLodSizeInv = 1.0 / fLodSize;
		vec2 cLodSizeInv = 1.0 / cLodSize;
		vec4 fSample = bicubic( sampler, uv, vec4( fLodSizeInv, fLodSize ), floor( lod ) );
		vec4 cSample = bicubic( sampler, uv, vec4( cLodSizeInv, cLodSize ), ceil( lod ) );
		return mix( fSample, cSample, fract( lod ) );
	}
	vec3 getVolumeTransmissionRay( const in vec3 n, const in vec3 v, const in float thickness, const in float ior, const in mat4 modelMatrix ) {
		vec3 refractionVector = refract( - v, normalize( n ), 1.0 / ior );
		vec3 modelScale;
		modelScale.x = length( vec3( modelMatrix[ 0 ].xyz ) );
		modelScale.y = length( vec3( modelMatrix[ 1 ].xyz ) );
		modelScale.z = length( vec3( modelMatrix[ 2 ].xyz ) );
		return normalize( refractionVector ) * thickness * modelScale;
	}
	float applyIorToRoughness( const in float roughness, const in float ior ) {
		return roughness * clamp( ior * 2.0 - 2.0, 0.0, 1.0 );
	}
	vec4 getTransmissionSample( const in vec2 fragCoord, const in float roughness, const in float ior ) {
		float lod = log2( transmissionSamplerSize.x ) * applyIorToRoughness( roughness, ior );
		return textureBicubic( transmissionSamplerMap, fragCoord.xy, lod );
	}
	vec3 volumeAttenuation( const in float transmissionDistance, const in vec3 attenuationColor, const in float attenuationDistance ) {
		if ( isinf( attenuationDistance ) ) {
			return vec3( 1.0 );
		} else {
			vec3 attenuationCoefficient = -log( attenuationColor ) / attenuationDistance;
			vec3 transmittance = exp( - attenuationCoefficient * transmissionDistance );			return transmittance;
		}
	}
	vec4 getIBLVolumeRefraction( const in vec3 n, const in vec3 v, const in float roughness, const in vec3 diffuseColor,
		const in vec3 specularColor, const in float specularF90, const in vec3 position, const in mat4 modelMatrix,
		const in mat4 viewMatrix, const in mat4 projMatrix, const in float dispersion, const in float ior, const in float thickness,
		const in vec3 attenuationColor, const in float attenuationDistance ) {
		vec4 transmittedLight;
		vec3 transmittance;
		#ifdef USE_DISPERSION
			float halfSpread = ( ior - 1.0 ) * 0.025 * dispersion;
			vec3 iors = vec3( ior - halfSpread, ior, ior + halfSpread );
			for ( int i = 0; i < 3; i ++ ) {
				vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, iors[ i ], modelMatrix );
				vec3 refractedRayExit = position + transmissionRay;
				vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
				vec2 refractionCoords = ndcPos.xy / ndcPos.w;
				refractionCoords += 1.0;
				refractionCoords /= 2.0;
				vec4 transmissionSample = getTransmissionSample( refractionCoords, roughness, iors[ i ] );
				transmittedLight[ i ] = transmissionSample[ i ];
				transmittedLight.a += transmissionSample.a;
				transmittance[ i ] = diffuseColor[ i ] * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance )[ i ];
			}
			transmittedLight.a /= 3.0;
		#else
			vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, ior, modelMatrix );
			vec3 refractedRayExit = position + transmissionRay;
			vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
			vec2 refractionCoords = ndcPos.xy / ndcPos.w;
			refractionCoords += 1.0;
			refractionCoords /= 2.0;
			transmittedLight = getTransmissionSample( refractionCoords, roughness, ior );
			transmittance = diffuseColor * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance );
		#endif
		vec3 attenuatedColor = transmittance * transmittedLight.rgb;
		vec3 F = EnvironmentBRDF( n, v, specularColor, specularF90, roughness );
		float transmittanceFactor = ( transmittance.r + transmittance.g + transmittance.b ) / 3.0;
		return vec4( ( 1.0 - F ) * attenuatedColor, 1.0 - ( 1.0 - transmittedLight.a ) * transmittanceFactor );
	}
#endif`,YM=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_SPECULARMAP
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,ZM=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	uniform mat3 mapTransform;
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	uniform mat3 alphaMapTransform;
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	uniform mat3 lightMapTransform;
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	uniform mat3 aoMapTransform;
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	uniform mat3 bumpMapTransform;
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	uniform mat3 normalMapTransform;
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_DISPLACEMENTMAP
	uniform mat3 displacementMapTransform;
	varying vec2 vDisplacementMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	uniform mat3 emissiveMapTransform;
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	uniform mat3 metalnessMapTransform;
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	uniform mat3 roughnessMapTransform;
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	uniform mat3 diffuseRoughnessMapTransform;
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	uniform mat3 anisotropyMapTransform;
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	uniform mat3 clearcoatMapTransform;
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform mat3 clearcoatNormalMapTransform;
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform mat3 clearcoatRoughnessMapTransform;
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	uniform mat3 sheenColorMapTransform;
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	uniform mat3 sheenRoughnessMapTransform;
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	uniform mat3 iridescenceMapTransform;
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform mat3 iridescenceThicknessMapTransform;
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SPECULARMAP
	uniform mat3 specularMapTransform;
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	uniform mat3 specularColorMapTransform;
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	uniform mat3 specularIntensityMapTransform;
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,$M=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	vUv = vec3( uv, 1 ).xy;
#endif
#ifdef USE_MAP
	vMapUv = ( mapTransform * vec3( MAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ALPHAMAP
	vAlphaMapUv = ( alphaMapTransform * vec3( ALPHAMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_LIGHTMAP
	vLightMapUv = ( lightMapTransform * vec3( LIGHTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_AOMAP
	vAoMapUv = ( aoMapTransform * vec3( AOMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_BUMPMAP
	vBumpMapUv = ( bumpMapTransform * vec3( BUMPMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_NORMALMAP
	vNormalMapUv = ( normalMapTransform * vec3( NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DISPLACEMENTMAP
	vDisplacementMapUv = ( displacementMapTransform * vec3( DISPLACEMENTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_EMISSIVEMAP
	vEmissiveMapUv = ( emissiveMapTransform * vec3( EMISSIVEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_METALNESSMAP
	vMetalnessMapUv = ( metalnessMapTransform * vec3( METALNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ROUGHNESSMAP
	vRoughnessMapUv = ( roughnessMapTransform * vec3( ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	vDiffuseRoughnessMapUv = ( diffuseRoughnessMapTransform * vec3( DIFFUSE_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ANISOTROPYMAP
	vAnisotropyMapUv = ( anisotropyMapTransform * vec3( ANISOTROPYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOATMAP
	vClearcoatMapUv = ( clearcoatMapTransform * vec3( CLEARCOATMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	vClearcoatNormalMapUv = ( clearcoatNormalMapTransform * vec3( CLEARCOAT_NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	vClearcoatRoughnessMapUv = ( clearcoatRoughnessMapTransform * vec3( CLEARCOAT_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCEMAP
	vIridescenceMapUv = ( iridescenceMapTransform * vec3( IRIDESCENCEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	vIridescenceThicknessMapUv = ( iridescenceThicknessMapTransform * vec3( IRIDESCENCE_THICKNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_COLORMAP
	vSheenColorMapUv = ( sheenColorMapTransform * vec3( SHEEN_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	vSheenRoughnessMapUv = ( sheenRoughnessMapTransform * vec3( SHEEN_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULARMAP
	vSpecularMapUv = ( specularMapTransform * vec3( SPECULARMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_COLORMAP
	vSpecularColorMapUv = ( specularColorMapTransform * vec3( SPECULAR_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	vSpecularIntensityMapUv = ( specularIntensityMapTransform * vec3( SPECULAR_INTENSITYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_TRANSMISSIONMAP
	vTransmissionMapUv = ( transmissionMapTransform * vec3( TRANSMISSIONMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_THICKNESSMAP
	vThicknessMapUv = ( thicknessMapTransform * vec3( THICKNESSMAP_UV, 1 ) ).xy;
#endif`,KM=`#if defined( USE_ENVMAP ) || defined( DISTANCE ) || defined ( USE_SHADOWMAP ) || defined ( USE_TRANSMISSION ) || NUM_SPOT_LIGHT_COORDS > 0
	vec4 worldPosition = vec4( transformed, 1.0 );
	#ifdef USE_BATCHING
		worldPosition = batchingMatrix * worldPosition;
	#endif
	#ifdef USE_INSTANCING
		worldPosition = instanceMatrix * worldPosition;
	#endif
	worldPosition = modelMatrix * worldPosition;
#endif`,JM=`varying vec2 vUv;
uniform mat3 uvTransform;
void main() {
	vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	gl_Position = vec4( position.xy, 1.0, 1.0 );
}`,jM=`uniform sampler2D t2D;
uniform float backgroundIntensity;
varying vec2 vUv;
void main() {
	vec4 texColor = texture2D( t2D, vUv );
	#ifdef DECODE_VIDEO_TEXTURE
		texColor = vec4( mix( pow( texColor.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), texColor.rgb * 0.0773993808, vec3( lessThanEqual( texColor.rgb, vec3( 0.04045 ) ) ) ), texColor.w );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,QM=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,tb=`uniform float backgroundBlurriness;
uniform float backgroundIntensity;
uniform mat3 backgroundRotation;
varying vec3 vWorldDirection;
#include <envmap_common_pars_fragment>
void main() {
	#ifdef ENVMAP_TYPE_PMREM
		vec4 texColor = textureLod( envMap, backgroundRotation * vWorldDirection, roughnessToMip( backgroundBlurriness ) );
	#else
		vec4 texColor = textureCube( envMap, backgroundRotation * vWorldDirection );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,eb=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,nb=`uniform samplerCube tCube;
uniform float tFlip;
uniform float opacity;
varying vec3 vWorldDirection;
void main() {
	vec4 texColor = textureCube( tCube, vec3( tFlip * vWorldDirection.x, vWorldDirection.yz ) );
	gl_FragColor = texColor;
	gl_FragColor.a *= opacity;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,ib=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
varying vec2 vHighPrecisionZW;
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vHighPrecisionZW = gl_Position.zw;
}`,sb=`#if DEPTH_PACKING == 3200
	uniform float opacity;
#endif
#include <common>
#include <packing>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
varying vec2 vHighPrecisionZW;
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#if DEPTH_PACKING == 3200
		diffuseColor.a = opacity;
	#endif
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <logdepthbuf_fragment>
	#ifdef USE_REVERSED_DEPTH_BUFFER
		float fragCoordZ = vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ];
	#else
		float fragCoordZ = 0.5 * vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ] + 0.5;
	#endif
	#if DEPTH_PACKING == 3200
		gl_FragColor = vec4( vec3( 1.0 - fragCoordZ ), opacity );
	#elif DEPTH_PACKING == 3201
		gl_FragColor = packDepthToRGBA( fragCoordZ );
	#elif DEPTH_PACKING == 3202
		gl_FragColor = vec4( packDepthToRGB( fragCoordZ ), 1.0 );
	#elif DEPTH_PACKING == 3203
		gl_FragColor = vec4( packDepthToRG( fragCoordZ ), 0.0, 1.0 );
	#endif
}`,rb=`#define DISTANCE
varying vec3 vWorldPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <worldpos_vertex>
	#include <clipping_planes_vertex>
	vWorldPosition = worldPosition.xyz;
}`,ob=`#define DISTANCE
uniform vec3 referencePosition;
uniform float nearDistance;
uniform float farDistance;
varying vec3 vWorldPosition;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	float dist = length( vWorldPosition - referencePosition );
	dist = ( dist - nearDistance ) / ( farDistance - nearDistance );
	dist = saturate( dist );
	gl_FragColor = vec4( dist, 0.0, 0.0, 1.0 );
}`,ab=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
}`,lb=`uniform sampler2D tEquirect;
varying vec3 vWorldDirection;
#include <common>
void main() {
	vec3 direction = normalize( vWorldDirection );
	vec2 sampleUV = equirectUv( direction );
	gl_FragColor = texture2D( tEquirect, sampleUV );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,cb=`uniform float scale;
attribute float lineDistance;
varying float vLineDistance;
#include <common>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	vLineDistance = scale * lineDistance;
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,hb=`uniform vec3 diffuse;
uniform float opacity;
uniform float dashSize;
uniform float totalSize;
varying float vLineDistance;
#include <common>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	if ( mod( vLineDistance, totalSize ) > dashSize ) {
		discard;
	}
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,ub=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#if defined ( USE_ENVMAP ) || defined ( USE_SKINNING )
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinbase_vertex>
		#include <skinnormal_vertex>
		#include <defaultnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <fog_vertex>
}`,fb=`uniform vec3 diffuse;
uniform float opacity;
#ifndef FLAT_SHADED
	varying vec3 vNormal;
#endif
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <fog_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		reflectedLight.indirectDiffuse += lightMapTexel.rgb * lightMapIntensity * RECIPROCAL_PI;
	#else
		reflectedLight.indirectDiffuse += vec3( 1.0 );
	#endif
	#include <aomap_fragment>
	reflectedLight.indirectDiffuse *= diffuseColor.rgb;
	vec3 outgoingLight = reflectedLight.indirectDiffuse;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,db=`#define LAMBERT
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,pb=`#define LAMBERT
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_lambert_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_lambert_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,mb=`#define MATCAP
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <displacementmap_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
	vViewPosition = - mvPosition.xyz;
}`,gb=`#define MATCAP
uniform vec3 diffuse;
uniform float opacity;
uniform sampler2D matcap;
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	vec3 viewDir = normalize( vViewPosition );
	vec3 x = normalize( vec3( viewDir.z, 0.0, - viewDir.x ) );
	vec3 y = cross( viewDir, x );
	vec2 uv = vec2( dot( x, normal ), dot( y, normal ) ) * 0.495 + 0.5;
	#ifdef USE_MATCAP
		vec4 matcapColor = texture2D( matcap, uv );
	#else
		vec4 matcapColor = vec4( vec3( mix( 0.2, 0.8, uv.y ) ), 1.0 );
	#endif
	vec3 outgoingLight = diffuseColor.rgb * matcapColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,_b=`#define NORMAL
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	vViewPosition = - mvPosition.xyz;
#endif
}`,xb=`#define NORMAL
uniform float opacity;
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <uv_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 0.0, 0.0, 0.0, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	gl_FragColor = vec4( normalize( normal ) * 0.5 + 0.5, diffuseColor.a );
	#ifdef OPAQUE
		gl_FragColor.a = 1.0;
	#endif
}`,yb=`#define PHONG
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,vb=`#define PHONG
uniform vec3 diffuse;
uniform vec3 emissive;
uniform vec3 specular;
uniform float shininess;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_phong_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_phong_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + reflectedLight.directSpecular + reflectedLight.indirectSpecular + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Sb=`#define STANDARD
varying vec3 vViewPosition;
#ifdef USE_TRANSMISSION
	varying vec3 vWorldPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
#ifdef USE_TRANSMISSION
	vWorldPosition = worldPosition.xyz;
#endif
}`,Mb=`#define STANDARD
#ifdef PHYSICAL
	#define IOR
	#define USE_SPECULAR
#endif
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float roughness;
uniform float metalness;
uniform float opacity;
#ifdef IOR
	uniform float ior;
#endif
#ifdef USE_SPECULAR
	uniform float specularIntensity;
	uniform vec3 specularColor;
	#ifdef USE_SPECULAR_COLORMAP
		uniform sampler2D specularColorMap;
	#endif
	#ifdef USE_SPECULAR_INTENSITYMAP
		uniform sampler2D specularIntensityMap;
	#endif
#endif
#ifdef USE_CLEARCOAT
	uniform float clearcoat;
	uniform float clearcoatRoughness;
#endif
#ifdef USE_DIFFUSE_ROUGHNESS
	uniform float diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		uniform sampler2D diffuseRoughnessMap;
	#endif
#endif
#ifdef USE_DISPERSION
	uniform float dispersion;
#endif
#ifdef USE_RETROREFLECTION
	uniform float retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	uniform float iridescence;
	uniform float iridescenceIOR;
	uniform float iridescenceThicknessMinimum;
	uniform float iridescenceThicknessMaximum;
#endif
#ifdef USE_SHEEN
	uniform vec3 sheenColor;
	uniform float sheenRoughness;
	#ifdef USE_SHEEN_COLORMAP
		uniform sampler2D sheenColorMap;
	#endif
	#ifdef USE_SHEEN_ROUGHNESSMAP
		uniform sampler2D sheenRoughnessMap;
	#endif
#endif
#ifdef USE_ANISOTROPY
	uniform vec2 anisotropyVector;
	#ifdef USE_ANISOTROPYMAP
		uniform sampler2D anisotropyMap;
	#endif
#endif
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <iridescence_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_physical_pars_fragment>
#include <transmission_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <clearcoat_pars_fragment>
#include <iridescence_pars_fragment>
#include <roughnessmap_pars_fragment>
#include <metalnessmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <roughnessmap_fragment>
	#include <metalnessmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <clearcoat_normal_fragment_begin>
	#include <clearcoat_normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_physical_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 totalDiffuse = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse;
	vec3 totalSpecular = reflectedLight.directSpecular + reflectedLight.indirectSpecular;
	#include <transmission_fragment>
	vec3 outgoingLight = totalDiffuse + totalSpecular + totalEmissiveRadiance;
	#ifdef USE_SHEEN
 
		outgoingLight = outgoingLight + sheenSpecularDirect + sheenSpecularIndirect;
 
 	#endif
	#ifdef USE_CLEARCOAT
		float dotNVcc = saturate( dot( geometryClearcoatNormal, geometryViewDir ) );
		vec3 Fcc = F_Schlick( material.clearcoatF0, material.clearcoatF90, dotNVcc );
		outgoingLight = outgoingLight * ( 1.0 - material.clearcoat * Fcc ) + ( clearcoatSpecularDirect + clearcoatSpecularIndirect ) * material.clearcoat;
	#endif
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,bb=`#define TOON
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,wb=`#define TOON
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <gradientmap_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_toon_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_toon_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Tb=`uniform float size;
uniform float scale;
#include <common>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
#ifdef USE_POINTS_UV
	varying vec2 vUv;
	uniform mat3 uvTransform;
#endif
void main() {
	#ifdef USE_POINTS_UV
		vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	#endif
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	gl_PointSize = size;
	#ifdef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) gl_PointSize *= ( scale / - mvPosition.z );
	#endif
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <fog_vertex>
}`,Ab=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <color_pars_fragment>
#include <map_particle_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_particle_fragment>
	#include <color_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,Eb=`#include <common>
#include <batching_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <shadowmap_pars_vertex>
void main() {
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,Cb=`uniform vec3 color;
uniform float opacity;
#include <common>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <logdepthbuf_pars_fragment>
#include <shadowmap_pars_fragment>
#include <shadowmask_pars_fragment>
void main() {
	#include <logdepthbuf_fragment>
	gl_FragColor = vec4( color, opacity * ( 1.0 - getShadowMask() ) );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,Rb=`uniform float rotation;
uniform vec2 center;
#include <common>
#include <uv_pars_vertex>
#include <fog_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	vec4 mvPosition = modelViewMatrix[ 3 ];
	vec2 scale = vec2( length( modelMatrix[ 0 ].xyz ), length( modelMatrix[ 1 ].xyz ) );
	#ifndef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) scale *= - mvPosition.z;
	#endif
	vec2 alignedPosition = ( position.xy - ( center - vec2( 0.5 ) ) ) * scale;
	vec2 rotatedPosition;
	rotatedPosition.x = cos( rotation ) * alignedPosition.x - sin( rotation ) * alignedPosition.y;
	rotatedPosition.y = sin( rotation ) * alignedPosition.x + cos( rotation ) * alignedPosition.y;
	mvPosition.xy += rotatedPosition;
	gl_Position = projectionMatrix * mvPosition;
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,Pb=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
}`,fe={alphahash_fragment:jv,alphahash_pars_fragment:Qv,alphamap_fragment:tS,alphamap_pars_fragment:eS,alphatest_fragment:nS,alphatest_pars_fragment:iS,aomap_fragment:sS,aomap_pars_fragment:rS,batching_pars_vertex:oS,batching_vertex:aS,begin_vertex:lS,beginnormal_vertex:cS,bsdfs:hS,iridescence_fragment:uS,bumpmap_pars_fragment:fS,clipping_planes_fragment:dS,clipping_planes_pars_fragment:pS,clipping_planes_pars_vertex:mS,clipping_planes_vertex:gS,color_fragment:_S,color_pars_fragment:xS,color_pars_vertex:yS,color_vertex:vS,common:SS,defaultnormal_vertex:MS,displacementmap_pars_vertex:bS,displacementmap_vertex:wS,emissivemap_fragment:TS,emissivemap_pars_fragment:AS,colorspace_fragment:ES,colorspace_pars_fragment:CS,envmap_fragment:RS,envmap_common_pars_fragment:PS,envmap_pars_fragment:IS,envmap_pars_vertex:LS,envmap_physical_pars_fragment:HS,envmap_vertex:DS,fog_vertex:NS,fog_pars_vertex:US,fog_fragment:FS,fog_pars_fragment:OS,gradientmap_pars_fragment:BS,lightmap_pars_fragment:zS,lights_lambert_fragment:kS,lights_lambert_pars_fragment:VS,lights_pars_begin:GS,lights_toon_fragment:WS,lights_toon_pars_fragment:XS,lights_phong_fragment:qS,lights_phong_pars_fragment:YS,lights_physical_fragment:ZS,lights_physical_pars_fragment:$S,lights_fragment_begin:KS,lights_fragment_maps:JS,lights_fragment_end:jS,lightprobes_pars_fragment:QS,logdepthbuf_fragment:tM,logdepthbuf_pars_fragment:eM,logdepthbuf_pars_vertex:nM,logdepthbuf_vertex:iM,map_fragment:sM,map_pars_fragment:rM,map_particle_fragment:oM,map_particle_pars_fragment:aM,metalnessmap_fragment:lM,metalnessmap_pars_fragment:cM,morphinstance_vertex:hM,morphcolor_vertex:uM,morphnormal_vertex:fM,morphtarget_pars_vertex:dM,morphtarget_vertex:pM,normal_fragment_begin:mM,normal_fragment_maps:gM,normal_pars_fragment:_M,normal_pars_vertex:xM,normal_vertex:yM,normalmap_pars_fragment:vM,clearcoat_normal_fragment_begin:SM,clearcoat_normal_fragment_maps:MM,clearcoat_pars_fragment:bM,iridescence_pars_fragment:wM,opaque_fragment:TM,packing:AM,premultiplied_alpha_fragment:EM,project_vertex:CM,dithering_fragment:RM,dithering_pars_fragment:PM,roughnessmap_fragment:IM,roughnessmap_pars_fragment:LM,shadowmap_pars_fragment:DM,shadowmap_pars_vertex:NM,shadowmap_vertex:UM,shadowmask_pars_fragment:FM,skinbase_vertex:OM,skinning_pars_vertex:BM,skinning_vertex:zM,skinnormal_vertex:kM,specularmap_fragment:VM,specularmap_pars_fragment:GM,tonemapping_fragment:HM,tonemapping_pars_fragment:WM,transmission_fragment:XM,transmission_pars_fragment:qM,uv_pars_fragment:YM,uv_pars_vertex:ZM,uv_vertex:$M,worldpos_vertex:KM,background_vert:JM,background_frag:jM,backgroundCube_vert:QM,backgroundCube_frag:tb,cube_vert:eb,cube_frag:nb,depth_vert:ib,depth_frag:sb,distance_vert:rb,distance_frag:ob,equirect_vert:ab,equirect_frag:lb,linedashed_vert:cb,linedashed_frag:hb,meshbasic_vert:ub,meshbasic_frag:fb,meshlambert_vert:db,meshlambert_frag:pb,meshmatcap_vert:mb,meshmatcap_frag:gb,meshnormal_vert:_b,meshnormal_frag:xb,meshphong_vert:yb,meshphong_frag:vb,meshphysical_vert:Sb,meshphysical_frag:Mb,meshtoon_vert:bb,meshtoon_frag:wb,points_vert:Tb,points_frag:Ab,shadow_vert:Eb,shadow_frag:Cb,sprite_vert:Rb,sprite_frag:Pb},Lt={common:{diffuse:{value:new $t(16777215)},opacity:{value:1},map:{value:null},mapTransform:{value:new ie},alphaMap:{value:null},alphaMapTransform:{value:new ie},alphaTest:{value:0}},specularmap:{specularMap:{value:null},specularMapTransform:{value:new ie}},envmap:{envMap:{value:null},envMapRotation:{value:new ie},reflectivity:{value:1},ior:{value:1.5},refractionRatio:{value:.98},dfgLUT:{value:null}},aomap:{aoMap:{value:null},aoMapIntensity:{value:1},aoMapTransform:{value:new ie}},lightmap:{lightMap:{value:null},lightMapIntensity:{value:1},lightMapTransform:{value:new ie}},bumpmap:{bumpMap:{value:null},bumpMapTransform:{value:new ie},bumpScale:{value:1}},normalmap:{normalMap:{value:null},normalMapTransform:{value:new ie},normalScale:{value:new kt(1,1)}},displacementmap:{displacementMap:{value:null},displacementMapTransform:{value:new ie},displacementScale:{value:1},displacementBias:{value:0}},emissivemap:{emissiveMap:{value:null},emissiveMapTransform:{value:new ie}},metalnessmap:{metalnessMap:{value:null},metalnessMapTransform:{value:new ie}},roughnessmap:{roughnessMap:{value:null},roughnessMapTransform:{value:new ie}},gradientmap:{gradientMap:{value:null}},fog:{fogDensity:{value:25e-5},fogNear:{value:1},fogFar:{value:2e3},fogColor:{value:new $t(16777215)}},lights:{ambientLightColor:{value:[]},lightProbe:{value:[]},sunLights:{value:[],properties:{direction:{},color:{}}},sunLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},sunShadowMatrix:{value:[]},sunShadowCascade:{value:[]},directionalLights:{value:[],properties:{direction:{},color:{}}},directionalLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},directionalShadowMatrix:{value:[]},spotLights:{value:[],properties:{color:{},position:{},direction:{},distance:{},coneCos:{},penumbraCos:{},decay:{}}},spotLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},spotLightMap:{value:[]},spotLightMatrix:{value:[]},pointLights:{value:[],properties:{color:{},position:{},decay:{},distance:{}}},pointLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{},shadowCameraNear:{},shadowCameraFar:{}}},pointShadowMatrix:{value:[]},hemisphereLights:{value:[],properties:{direction:{},skyColor:{},groundColor:{}}},rectAreaLights:{value:[],properties:{color:{},position:{},width:{},height:{}}},ltc_1:{value:null},ltc_2:{value:null},probesSH:{value:[]},probesMin:{value:[]},probesMax:{value:[]},probesResolution:{value:[]}},points:{diffuse:{value:new $t(16777215)},opacity:{value:1},size:{value:1},scale:{value:1},map:{value:null},alphaMap:{value:null},alphaMapTransform:{value:new ie},alphaTest:{value:0},uvTransform:{value:new ie}},sprite:{diffuse:{value:new $t(16777215)},opacity:{value:1},center:{value:new kt(.5,.5)},rotation:{value:0},map:{value:null},mapTransform:{value:new ie},alphaMap:{value:null},alphaMapTransform:{value:new ie},alphaTest:{value:0}}},fs={basic:{uniforms:Kn([Lt.common,Lt.specularmap,Lt.envmap,Lt.aomap,Lt.lightmap,Lt.fog]),vertexShader:fe.meshbasic_vert,fragmentShader:fe.meshbasic_frag},lambert:{uniforms:Kn([Lt.common,Lt.specularmap,Lt.envmap,Lt.aomap,Lt.lightmap,Lt.emissivemap,Lt.bumpmap,Lt.normalmap,Lt.displacementmap,Lt.fog,Lt.lights,{emissive:{value:new $t(0)},envMapIntensity:{value:1}}]),vertexShader:fe.meshlambert_vert,fragmentShader:fe.meshlambert_frag},phong:{uniforms:Kn([Lt.common,Lt.specularmap,Lt.envmap,Lt.aomap,Lt.lightmap,Lt.emissivemap,Lt.bumpmap,Lt.normalmap,Lt.displacementmap,Lt.fog,Lt.lights,{emissive:{value:new $t(0)},specular:{value:new $t(1118481)},shininess:{value:30},envMapIntensity:{value:1}}]),vertexShader:fe.meshphong_vert,fragmentShader:fe.meshphong_frag},standard:{uniforms:Kn([Lt.common,Lt.envmap,Lt.aomap,Lt.lightmap,Lt.emissivemap,Lt.bumpmap,Lt.normalmap,Lt.displacementmap,Lt.roughnessmap,Lt.metalnessmap,Lt.fog,Lt.lights,{emissive:{value:new $t(0)},roughness:{value:1},metalness:{value:0},envMapIntensity:{value:1}}]),vertexShader:fe.meshphysical_vert,fragmentShader:fe.meshphysical_frag},toon:{uniforms:Kn([Lt.common,Lt.aomap,Lt.lightmap,Lt.emissivemap,Lt.bumpmap,Lt.normalmap,Lt.displacementmap,Lt.gradientmap,Lt.fog,Lt.lights,{emissive:{value:new $t(0)}}]),vertexShader:fe.meshtoon_vert,fragmentShader:fe.meshtoon_frag},matcap:{uniforms:Kn([Lt.common,Lt.bumpmap,Lt.normalmap,Lt.displacementmap,Lt.fog,{matcap:{value:null}}]),vertexShader:fe.meshmatcap_vert,fragmentShader:fe.meshmatcap_frag},points:{uniforms:Kn([Lt.points,Lt.fog]),vertexShader:fe.points_vert,fragmentShader:fe.points_frag},dashed:{uniforms:Kn([Lt.common,Lt.fog,{scale:{value:1},dashSize:{value:1},totalSize:{value:2}}]),vertexShader:fe.linedashed_vert,fragmentShader:fe.linedashed_frag},depth:{uniforms:Kn([Lt.common,Lt.displacementmap]),vertexShader:fe.depth_vert,fragmentShader:fe.depth_frag},normal:{uniforms:Kn([Lt.common,Lt.bumpmap,Lt.normalmap,Lt.displacementmap,{opacity:{value:1}}]),vertexShader:fe.meshnormal_vert,fragmentShader:fe.meshnormal_frag},sprite:{uniforms:Kn([Lt.sprite,Lt.fog]),vertexShader:fe.sprite_vert,fragmentShader:fe.sprite_frag},background:{uniforms:{uvTransform:{value:new ie},t2D:{value:null},backgroundIntensity:{value:1}},vertexShader:fe.background_vert,fragmentShader:fe.background_frag},backgroundCube:{uniforms:{envMap:{value:null},backgroundBlurriness:{value:0},backgroundIntensity:{value:1},backgroundRotation:{value:new ie}},vertexShader:fe.backgroundCube_vert,fragmentShader:fe.backgroundCube_frag},cube:{uniforms:{tCube:{value:null},tFlip:{value:-1},opacity:{value:1}},vertexShader:fe.cube_vert,fragmentShader:fe.cube_frag},equirect:{uniforms:{tEquirect:{value:null}},vertexShader:fe.equirect_vert,fragmentShader:fe.equirect_frag},distance:{uniforms:Kn([Lt.common,Lt.displacementmap,{referencePosition:{value:new U},nearDistance:{value:1},farDistance:{value:1e3}}]),vertexShader:fe.distance_vert,fragmentShader:fe.distance_frag},shadow:{uniforms:Kn([Lt.lights,Lt.fog,{color:{value:new $t(0)},opacity:{value:1}}]),vertexShader:fe.shadow_vert,fragmentShader:fe.shadow_frag}};fs.physical={uniforms:Kn([fs.standard.uniforms,{clearcoat:{value:0},clearcoatMap:{value:null},clearcoatMapTransform:{value:new ie},clearcoatNormalMap:{value:null},clearcoatNormalMapTransform:{value:new ie},clearcoatNormalScale:{value:new kt(1,1)},clearcoatRoughness:{value:0},clearcoatRoughnessMap:{value:null},clearcoatRoughnessMapTransform:{value:new ie},diffuseRoughness:{value:0},diffuseRoughnessMap:{value:null},diffuseRoughnessMapTransform:{value:new ie},dispersion:{value:0},retroreflectivity:{value:0},iridescence:{value:0},iridescenceMap:{value:null},iridescenceMapTransform:{value:new ie},iridescenceIOR:{value:1.3},iridescenceThicknessMinimum:{value:100},iridescenceThicknessMaximum:{value:400},iridescenceThicknessMap:{value:null},iridescenceThicknessMapTransform:{value:new ie},sheen:{value:0},sheenColor:{value:new $t(0)},sheenColorMap:{value:null},sheenColorMapTransform:{value:new ie},sheenRoughness:{value:1},sheenRoughnessMap:{value:null},sheenRoughnessMapTransform:{value:new ie},transmission:{value:0},transmissionMap:{value:null},transmissionMapTransform:{value:new ie},transmissionSamplerSize:{value:new kt},transmissionSamplerMap:{value:null},thickness:{value:0},thicknessMap:{value:null},thicknessMapTransform:{value:new ie},attenuationDistance:{value:0},attenuationColor:{value:new $t(0)},specularColor:{value:new $t(1,1,1)},specularColorMap:{value:null},specularColorMapTransform:{value:new ie},specularIntensity:{value:1},specularIntensityMap:{value:null},specularIntensityMapTransform:{value:new ie},anisotropyVector:{value:new kt},anisotropyMap:{value:null},anisotropyMapTransform:{value:new ie}}]),vertexShader:fe.meshphysical_vert,fragmentShader:fe.meshphysical_frag};var Lh={r:0,b:0,g:0},Ib=new te,L0=new ie;L0.set(-1,0,0,0,1,0,0,0,1);function Lb(i,t,e,n,s,r){let o=new $t(0),a=s===!0?0:1,l,c,f=null,u=0,h=null;function d(_){let M=_.isScene===!0?_.background:null;if(M&&M.isTexture){let y=_.backgroundBlurriness>0;M=t.get(M,y)}return M}function g(_){let M=!1,y=d(_);y===null?m(o,a):y&&y.isColor&&(m(y,1),M=!0);let w=i.xr.getEnvironmentBlendMode();w==="additive"?e.buffers.color.setClear(0,0,0,1,r):w==="alpha-blend"&&e.buffers.color.setClear(0,0,0,0,r),(i.autoClear||M)&&(e.buffers.depth.setTest(!0),e.buffers.depth.setMask(!0),e.buffers.color.setMask(!0),i.clear(i.autoClearColor,i.autoClearDepth,i.autoClearStencil))}function v(_,M){let y=d(M);y&&y.isCubeTexture?(c===void 0&&(c=new En(new Co(1,1,1),new ls({name:"BackgroundCubeMaterial",uniforms:Ir(fs.backgroundCube.uniforms),vertexShader:fs.backgroundCube.vertexShader,fragmentShader:fs.backgroundCube.fragmentShader,side:Cn,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),c.geometry.deleteAttribute("normal"),c.geometry.deleteAttribute("uv"),c.onBeforeRender=function(w,T,x){this.matrixWorld.copyPosition(x.matrixWorld)},Object.defineProperty(c.material,"envMap",{get:function(){return this.uniforms.envMap.value}}),n.update(c)),c.material.uniforms.envMap.value=y,c.material.uniforms.backgroundBlurriness.value=M.backgroundBlurriness,c.material.uniforms.backgroundIntensity.value=M.backgroundIntensity,c.material.uniforms.backgroundRotation.value.setFromMatrix4(Ib.makeRotationFromEuler(M.backgroundRotation)).transpose(),y.isRenderTargetTexture===!1&&c.material.uniforms.backgroundRotation.value.premultiply(L0),c.material.toneMapped=xe.getTransfer(y.colorSpace)!==Re,(f!==y||u!==y.version||h!==i.toneMapping)&&(c.material.needsUpdate=!0,f=y,u=y.version,h=i.toneMapping),c.layers.enableAll(),_.unshift(c,c.geometry,c.material,0,0,null)):y&&y.isTexture&&(l===void 0&&(l=new En(new Ar(2,2),new ls({name:"BackgroundMaterial",uniforms:Ir(fs.background.uniforms),vertexShader:fs.background.vertexShader,fragmentShader:fs.background.fragmentShader,side:Mi,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),l.geometry.deleteAttribute("normal"),Object.defineProperty(l.material,"map",{get:function(){return this.uniforms.t2D.value}}),n.update(l)),l.material.uniforms.t2D.value=y,l.material.uniforms.backgroundIntensity.value=M.backgroundIntensity,l.material.toneMapped=xe.getTransfer(y.colorSpace)!==Re,y.matrixAutoUpdate===!0&&y.updateMatrix(),l.material.uniforms.uvTransform.value.copy(y.matrix),(f!==y||u!==y.version||h!==i.toneMapping)&&(l.material.needsUpdate=!0,f=y,u=y.version,h=i.toneMapping),l.layers.enableAll(),_.unshift(l,l.geometry,l.material,0,0,null))}function m(_,M){_.getRGB(Lh,Od(i)),e.buffers.color.setClear(Lh.r,Lh.g,Lh.b,M,r)}function p(){c!==void 0&&(c.geometry.dispose(),c.material.dispose(),c=void 0),l!==void 0&&(l.geometry.dispose(),l.material.dispose(),l=void 0)}return{getClearColor:function(){return o},setClearColor:function(_,M=1){o.set(_),a=M,m(o,a)},getClearAlpha:function(){return a},setClearAlpha:function(_){a=_,m(o,a)},render:g,addToRenderList:v,dispose:p}}function Db(i,t){let e=i.getParameter(i.MAX_VERTEX_ATTRIBS),n={},s=h(null),r=s,o=!1;function a(P,I,O,L,z){let X=!1,H=u(P,L,O,I);r!==H&&(r=H,c(r.object)),X=d(P,L,O,z),X&&g(P,L,O,z),z!==null&&t.update(z,i.ELEMENT_ARRAY_BUFFER),(X||o)&&(o=!1,y(P,I,O,L),z!==null&&i.bindBuffer(i.ELEMENT_ARRAY_BUFFER,t.get(z).buffer))}function l(){return i.createVertexArray()}function c(P){return i.bindVertexArray(P)}function f(P){return i.deleteVertexArray(P)}function u(P,I,O,L){let z=L.wireframe===!0,X=n[I.id];X===void 0&&(X={},n[I.id]=X);let H=P.isInstancedMesh===!0?P.id:0,at=X[H];at===void 0&&(at={},X[H]=at);let Z=at[O.id];Z===void 0&&(Z={},at[O.id]=Z);let j=Z[z];return j===void 0&&(j=h(l()),Z[z]=j),j}function h(P){let I=[],O=[],L=[];for(let z=0;z<e;z++)I[z]=0,O[z]=0,L[z]=0;return{geometry:null,program:null,wireframe:!1,newAttributes:I,enabledAttributes:O,attributeDivisors:L,object:P,attributes:{},index:null}}function d(P,I,O,L){let z=r.attributes,X=I.attributes,H=0,at=O.getAttributes();for(let Z in at)if(at[Z].location>=0){let nt=z[Z],ut=X[Z];if(ut===void 0&&(Z==="instanceMatrix"&&P.instanceMatrix&&(ut=P.instanceMatrix),Z==="instanceColor"&&P.instanceColor&&(ut=P.instanceColor)),nt===void 0||nt.attribute!==ut||ut&&nt.data!==ut.data)return!0;H++}return r.attributesNum!==H||r.index!==L}function g(P,I,O,L){let z={},X=I.attributes,H=0,at=O.getAttributes();for(let Z in at)if(at[Z].location>=0){let nt=X[Z];nt===void 0&&(Z==="instanceMatrix"&&P.instanceMatrix&&(nt=P.instanceMatrix),Z==="instanceColor"&&P.instanceColor&&(nt=P.instanceColor));let ut={};ut.attribute=nt,nt&&nt.data&&(ut.data=nt.data),z[Z]=ut,H++}r.attributes=z,r.attributesNum=H,r.index=L}function v(){let P=r.newAttributes;for(let I=0,O=P.length;I<O;I++)P[I]=0}function m(P){p(P,0)}function p(P,I){let O=r.newAttributes,L=r.enabledAttributes,z=r.attributeDivisors;O[P]=1,L[P]===0&&(i.enableVertexAttribArray(P),L[P]=1),z[P]!==I&&(i.vertexAttribDivisor(P,I),z[P]=I)}function _(){let P=r.newAttributes,I=r.enabledAttributes;for(let O=0,L=I.length;O<L;O++)I[O]!==P[O]&&(i.disableVertexAttribArray(O),I[O]=0)}function M(P,I,O,L,z,X,H){H===!0?i.vertexAttribIPointer(P,I,O,z,X):i.vertexAttribPointer(P,I,O,L,z,X)}function y(P,I,O,L){v();let z=L.attributes,X=O.getAttributes(),H=I.defaultAttributeValues;for(let at in X){let Z=X[at];if(Z.location>=0){let j=z[at];if(j===void 0&&(at==="instanceMatrix"&&P.instanceMatrix&&(j=P.instanceMatrix),at==="instanceColor"&&P.instanceColor&&(j=P.instanceColor)),j!==void 0){let nt=j.normalized,ut=j.itemSize,ht=t.get(j);if(ht===void 0)continue;let Q=ht.buffer,dt=ht.type,gt=ht.bytesPerElement,Et=dt===i.INT||dt===i.UNSIGNED_INT||j.gpuType===Zc;if(j.isInterleavedBufferAttribute){let St=j.data,Ht=St.isInterleavedBuffer===!0?St.stride:St.itemSize,ne=j.offset;if(St.isInstancedInterleavedBuffer||St.isInstancedBufferAttribute){for(let Vt=0;Vt<Z.locationSize;Vt++)p(Z.location+Vt,St.meshPerAttribute);P.isInstancedMesh!==!0&&L._maxInstanceCount===void 0&&(L._maxInstanceCount=St.meshPerAttribute*St.count)}else for(let Vt=0;Vt<Z.locationSize;Vt++)m(Z.location+Vt);i.bindBuffer(i.ARRAY_BUFFER,Q);for(let Vt=0;Vt<Z.locationSize;Vt++)M(Z.location+Vt,ut/Z.locationSize,dt,nt,Ht*gt,(ne+ut/Z.locationSize*Vt)*gt,Et)}else{if(j.isInstancedBufferAttribute){for(let St=0;St<Z.locationSize;St++)p(Z.location+St,j.meshPerAttribute);P.isInstancedMesh!==!0&&L._maxInstanceCount===void 0&&(L._maxInstanceCount=j.meshPerAttribute*j.count)}else for(let St=0;St<Z.locationSize;St++)m(Z.location+St);i.bindBuffer(i.ARRAY_BUFFER,Q);for(let St=0;St<Z.locationSize;St++)M(Z.location+St,ut/Z.locationSize,dt,nt,ut*gt,ut/Z.locationSize*St*gt,Et)}}else if(H!==void 0){let nt=H[at];if(nt!==void 0)switch(nt.length){case 2:i.vertexAttrib2fv(Z.location,nt);break;case 3:i.vertexAttrib3fv(Z.location,nt);break;case 4:i.vertexAttrib4fv(Z.location,nt);break;default:i.vertexAttrib1fv(Z.location,nt)}}}}_()}function w(){D();for(let P in n){let I=n[P];for(let O in I){let L=I[O];for(let z in L){let X=L[z];for(let H in X)f(X[H].object),delete X[H];delete L[z]}}delete n[P]}}function T(P){if(n[P.id]===void 0)return;let I=n[P.id];for(let O in I){let L=I[O];for(let z in L){let X=L[z];for(let H in X)f(X[H].object),delete X[H];delete L[z]}}delete n[P.id]}function x(P){for(let I in n){let O=n[I];for(let L in O){let z=O[L];if(z[P.id]===void 0)continue;let X=z[P.id];for(let H in X)f(X[H].object),delete X[H];delete z[P.id]}}}function b(P){for(let I in n){let O=n[I],L=P.isInstancedMesh===!0?P.id:0,z=O[L];if(z!==void 0){for(let X in z){let H=z[X];for(let at in H)f(H[at].object),delete H[at];delete z[X]}delete O[L],Object.keys(O).length===0&&delete n[I]}}}function D(){C(),o=!0,r!==s&&(r=s,c(r.object))}function C(){s.geometry=null,s.program=null,s.wireframe=!1}return{setup:a,reset:D,resetDefaultState:C,dispose:w,releaseStatesOfGeometry:T,releaseStatesOfObject:b,releaseStatesOfProgram:x,initAttributes:v,enableAttribute:m,disableUnusedAttributes:_}}function Nb(i,t,e){let n;function s(l){n=l}function r(l,c){i.drawArrays(n,l,c),e.update(c,n,1)}function o(l,c,f){f!==0&&(i.drawArraysInstanced(n,l,c,f),e.update(c,n,f))}function a(l,c,f){if(f===0)return;t.get("WEBGL_multi_draw").multiDrawArraysWEBGL(n,l,0,c,0,f);let h=0;for(let d=0;d<f;d++)h+=c[d];e.update(h,n,1)}this.setMode=s,this.render=r,this.renderInstances=o,this.renderMultiDraw=a}function Ub(i,t,e,n){let s;function r(){if(s!==void 0)return s;if(t.has("EXT_texture_filter_anisotropic")===!0){let x=t.get("EXT_texture_filter_anisotropic");s=i.getParameter(x.MAX_TEXTURE_MAX_ANISOTROPY_EXT)}else s=0;return s}function o(x){return!(x!==Xi&&n.convert(x)!==i.getParameter(i.IMPLEMENTATION_COLOR_READ_FORMAT))}function a(x){let b=x===Wi&&(t.has("EXT_color_buffer_half_float")||t.has("EXT_color_buffer_float"));return!(x!==hi&&x!==ui&&!b&&n.convert(x)!==i.getParameter(i.IMPLEMENTATION_COLOR_READ_TYPE))}function l(x){if(x==="highp"){if(i.getShaderPrecisionFormat(i.VERTEX_SHADER,i.HIGH_FLOAT).precision>0&&i.getShaderPrecisionFormat(i.FRAGMENT_SHADER,i.HIGH_FLOAT).precision>0)return"highp";x="mediump"}return x==="mediump"&&i.getShaderPrecisionFormat(i.VERTEX_SHADER,i.MEDIUM_FLOAT).precision>0&&i.getShaderPrecisionFormat(i.FRAGMENT_SHADER,i.MEDIUM_FLOAT).precision>0?"mediump":"lowp"}let c=e.precision!==void 0?e.precision:"highp",f=l(c);f!==c&&(Yt("WebGLRenderer:",c,"not supported, using",f,"instead."),c=f);let u=e.reversedDepthBuffer===!0&&t.has("EXT_clip_control"),h=e.logarithmicDepthBuffer===!0&&u===!1;e.reversedDepthBuffer===!0&&u===!1&&Yt("WebGLRenderer: Unable to use reversed depth buffer due to missing EXT_clip_control extension. Fallback to default depth buffer."),e.logarithmicDepthBuffer===!0&&u===!0&&Yt("WebGLRenderer: Logarithmic depth buffer is ignored when reversed depth buffer is enabled.");let d=i.getParameter(i.MAX_TEXTURE_IMAGE_UNITS),g=i.getParameter(i.MAX_VERTEX_TEXTURE_IMAGE_UNITS),v=i.getParameter(i.MAX_TEXTURE_SIZE),m=i.getParameter(i.MAX_CUBE_MAP_TEXTURE_SIZE),p=i.getParameter(i.MAX_VERTEX_ATTRIBS),_=i.getParameter(i.MAX_VERTEX_UNIFORM_VECTORS),M=i.getParameter(i.MAX_VARYING_VECTORS),y=i.getParameter(i.MAX_FRAGMENT_UNIFORM_VECTORS),w=i.getParameter(i.MAX_SAMPLES),T=i.getParameter(i.SAMPLES);return{isWebGL2:!0,getMaxAnisotropy:r,getMaxPrecision:l,textureFormatReadable:o,textureTypeReadable:a,precision:c,logarithmicDepthBuffer:h,reversedDepthBuffer:u,maxTextures:d,maxVertexTextures:g,maxTextureSize:v,maxCubemapSize:m,maxAttributes:p,maxVertexUniforms:_,maxVaryings:M,maxFragmentUniforms:y,maxSamples:w,samples:T}}function Fb(i){let t=this,e=null,n=0,s=!1,r=!1,o=new An,a=new ie,l={value:null,needsUpdate:!1};this.uniform=l,this.numPlanes=0,this.numIntersection=0,this.init=function(u,h){let d=u.length!==0||h||n!==0||s;return s=h,n=u.length,d},this.beginShadows=function(){r=!0,f(null)},this.endShadows=function(){r=!1},this.setGlobalState=function(u,h){e=f(u,h,0)},this.setState=function(u,h,d){let g=u.clippingPlanes,v=u.clipIntersection,m=u.clipShadows,p=i.get(u);if(!s||g===null||g.length===0||r&&!m)r?f(null):c();else{let _=r?0:n,M=_*4,y=p.clippingState||null;l.value=y,y=f(g,h,M,d);for(let w=0;w!==M;++w)y[w]=e[w];p.clippingState=y,this.numIntersection=v?this.numPlanes:0,this.numPlanes+=_}};function c(){l.value!==e&&(l.value=e,l.needsUpdate=n>0),t.numPlanes=n,t.numIntersection=0}function f(u,h,d,g){let v=u!==null?u.length:0,m=null;if(v!==0){if(m=l.value,g!==!0||m===null){let p=d+v*4,_=h.matrixWorldInverse;a.getNormalMatrix(_),(m===null||m.length<p)&&(m=new Float32Array(p));for(let M=0,y=d;M!==v;++M,y+=4)o.copy(u[M]).applyMatrix4(_,a),o.normal.toArray(m,y),m[y+3]=o.constant}l.value=m,l.needsUpdate=!0}return t.numPlanes=v,t.numIntersection=0,m}}var dl=class extends vi{constructor(t=1,e={}){super(t,t,e),this.isWebGLCubeRenderTarget=!0;let n={width:t,height:t,depth:1},s=[n,n,n,n,n,n];this.texture=new Ha(s),this._setTextureOptions(e),this.texture.isRenderTargetTexture=!0}fromEquirectangularTexture(t,e){this.texture.type=e.type,this.texture.colorSpace=e.colorSpace,this.texture.generateMipmaps=e.generateMipmaps,this.texture.minFilter=e.minFilter,this.texture.magFilter=e.magFilter;let n={uniforms:{tEquirect:{value:null}},vertexShader:`

				varying vec3 vWorldDirection;

				vec3 transformDirection( in vec3 dir, in mat4 matrix ) {

					return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );

				}

				void main() {

					vWorldDirection = transformDirection( position, modelMatrix );

					#include <begin_vertex>
					#include <project_vertex>

				}
			`,fragmentShader:`

				uniform sampler2D tEquirect;

				varying vec3 vWorldDirection;

				#include <common>

				void main() {

					vec3 direction = normalize( vWorldDirection );

					vec2 sampleUV = equirectUv( direction );

					gl_FragColor = texture2D( tEquirect, sampleUV );

				}
			`},s=new Co(5,5,5),r=new ls({name:"CubemapFromEquirect",uniforms:Ir(n.uniforms),vertexShader:n.vertexShader,fragmentShader:n.fragmentShader,side:Cn,blending:Er});r.uniforms.tEquirect.value=e;let o=new En(s,r),a=e.minFilter;return e.minFilter===Ns&&(e.minFilter=si),new Po(1,10,this).update(t,o),e.minFilter=a,o.geometry.dispose(),o.material.dispose(),this}clear(t,e=!0,n=!0,s=!0){let r=t.getRenderTarget();for(let o=0;o<6;o++)t.setRenderTarget(this,o),t.clear(e,n,s);t.setRenderTarget(r)}},h0=256,Ob=3,Bb=20,D0=256,N0=16,zb=3,kb=new U,Vb=new $t,Nh=class i{constructor(t){this._renderer=t,this._cubeSize=0,this._sourceTarget=null,this._cubeCamera=new Po(1,10,null),this._boxMesh=new En(new Co(5,5,5),null),this._cubemapMaterial=null,this._equirectMaterial=null,this._blurMaterial=null,this._ggxMaterial=null,this._integrationMaterial=null}fromScene(t,e=0,n=.1,s=100,r={}){let{size:o=256,position:a=kb}=r,l=this._renderer;this._setSize(o);let c=this._allocateTarget(),f=this._getSourceTarget(!0);e>0&&(f.texture.mipmapsAutoUpdate=!1);let u=l.autoClear,h=l.autoClearColor,d=l.autoClearDepth,g=l.autoClearStencil,v=t.background;l.autoClear=!0,l.autoClearColor=!0,l.autoClearDepth=!0,l.autoClearStencil=!0,v===null&&(t.background=l.getClearColor(Vb));let m=new Po(n,s,f);return m.position.copy(a),m.update(l,t),l.autoClear=u,l.autoClearColor=h,l.autoClearDepth=d,l.autoClearStencil=g,t.background=v,e>0&&(f.texture.mipmapsAutoUpdate=!0,this._blur(c,e)),this._applyPMREM(c),c}fromEquirectangular(t,e=null){return this._fromTexture(t,e)}fromCubemap(t,e=null){return this._fromTexture(t,e)}compileCubemapShader(){this._cubemapMaterial===null&&(this._cubemapMaterial=d0(),this._compileMaterial(this._cubemapMaterial))}compileEquirectangularShader(){this._equirectMaterial===null&&(this._equirectMaterial=f0(),this._compileMaterial(this._equirectMaterial))}dispose(){this._sourceTarget!==null&&this._sourceTarget.dispose(),this._cubemapMaterial!==null&&this._cubemapMaterial.dispose(),this._equirectMaterial!==null&&this._equirectMaterial.dispose(),this._blurMaterial!==null&&this._blurMaterial.dispose(),this._ggxMaterial!==null&&this._ggxMaterial.dispose(),this._integrationMaterial!==null&&this._integrationMaterial.dispose(),this._boxMesh.geometry.dispose()}static lodToRoughness(t,e){return e>0?1-Math.sqrt(1-t/e):0}_setSize(t){this._cubeSize=Math.max(h0,Nd(t))}_fromTexture(t,e){t.mapping===Rr||t.mapping===No?this._setSize(t.image.length===0?h0:t.image[0].width||t.image[0].image.width):this._setSize(t.image.width/4);let n=e||this._allocateTarget();return this._textureToCubemap(t),this._applyPMREM(n),n}_allocateTarget(){let t=this._cubeSize,e=u0(t,!1,!1),n=Math.log2(t)-Ob;for(let s=0;s<=n;s++)e.texture.mipmaps.push({width:t>>s,height:t>>s});return e.texture.name="PMREM",e.texture.isPMREMTexture=!0,e}_getSourceTarget(t=!1){let e=this._cubeSize,n=this._sourceTarget;return(n===null||n.width!==e||t&&n.depthBuffer===!1)&&(n!==null&&n.dispose(),this._sourceTarget=u0(e,!0,t)),this._sourceTarget}_compileMaterial(t){this._boxMesh.material=t,this._renderer.compile(this._boxMesh,this._cubeCamera.children[0])}_renderCube(t,e,n){let s=this._boxMesh,r=this._cubeCamera;s.material=n,r.renderTarget=t,r.activeMipmapLevel=e;let o=t.width>>e;t.viewport.set(0,0,o,o),r.update(this._renderer,s),t.viewport.set(0,0,t.width,t.height)}_textureToCubemap(t){let e;t.mapping===Rr||t.mapping===No?(this._cubemapMaterial===null&&(this._cubemapMaterial=d0()),e=this._cubemapMaterial,e.uniforms.flipEnvMap.value=t.isRenderTargetTexture===!1?-1:1):(this._equirectMaterial===null&&(this._equirectMaterial=f0()),e=this._equirectMaterial),e.uniforms.envMap.value=t,this._renderCube(this._getSourceTarget(),0,e)}_applyPMREM(t){this._ggxMaterial===null&&(this._ggxMaterial=Gb(),this._integrationMaterial=Hb());let e=this._cubeSize,n=t.texture.mipmaps.length-1,s=this._ggxMaterial.uniforms;s.envMap.value=this._sourceTarget.texture;let r=this._integrationMaterial.uniforms;r.envMap.value=this._sourceTarget.texture,r.sourceLod.value=Math.log2(e/N0);for(let o=0;o<=n;o++){let a=i.lodToRoughness(o,n);if(o>n-zb)r.roughness.value=a,this._renderCube(t,o,this._integrationMaterial);else{let l=a>0?Math.log2(e)+.5*Math.log2(6/(D0*Math.pow(a,4)))+.5:0;s.roughness.value=a,s.lodBias.value=l,this._renderCube(t,o,this._ggxMaterial)}}}_blur(t,e){this._blurMaterial===null&&(this._blurMaterial=Wb());let n=this._blurMaterial,s=n.uniforms,r=this._sourceTarget;s.sigma.value=Math.min(e,Math.PI)/Math.SQRT2,s.envMap.value=r.texture,this._renderCube(t,0,n),s.envMap.value=t.texture,this._renderCube(r,0,n)}};function u0(i,t,e){return new dl(i,{minFilter:Ns,generateMipmaps:t,type:Wi,colorSpace:Na,depthBuffer:e})}function pl(i,t,e){return new ls({name:i,uniforms:t,vertexShader:fe.cube_vert,fragmentShader:e,side:Cn,blending:Er,depthTest:!1,depthWrite:!1})}function Gb(){return pl("PMREMGGXConvolution",{envMap:{value:null},roughness:{value:0},lodBias:{value:0}},`

		#define GGX_SAMPLES ${D0}u

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float lodBias;

		#include <common>

		// Van der Corput radical inverse
		float radicalInverse_VdC( uint bits ) {

			bits = ( bits << 16u ) | ( bits >> 16u );
			bits = ( ( bits & 0x55555555u ) << 1u ) | ( ( bits & 0xAAAAAAAAu ) >> 1u );
			bits = ( ( bits & 0x33333333u ) << 2u ) | ( ( bits & 0xCCCCCCCCu ) >> 2u );
			bits = ( ( bits & 0x0F0F0F0Fu ) << 4u ) | ( ( bits & 0xF0F0F0F0u ) >> 4u );
			bits = ( ( bits & 0x00FF00FFu ) << 8u ) | ( ( bits & 0xFF00FF00u ) >> 8u );
			return float( bits ) * 2.3283064365386963e-10; // / 0x100000000

		}

		// Hammersley sequence
		vec2 hammersley( uint i, uint N ) {

			return vec2( float( i ) / float( N ), radicalInverse_VdC( i ) );

		}

		void main() {

			vec3 N = normalize( vWorldDirection );

			// For very low roughness, just sample the environment directly
			if ( roughness < 0.001 ) {

				gl_FragColor = vec4( textureLod( envMap, N, 0.0 ).rgb, 1.0 );
				return;

			}

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			// Tangent space basis for VNDF sampling
			vec3 up = abs( N.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, N ) );
			vec3 bitangent = cross( N, tangent );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			for ( uint i = 0u; i < GGX_SAMPLES; i ++ ) {

				vec2 Xi = hammersley( i, GGX_SAMPLES );

				// With V = N, sample the reflected direction directly.
				float invQ = 1.0 / ( 1.0 - Xi.x + alpha2 * Xi.x );
				float NdotL = ( 1.0 - Xi.x - alpha2 * Xi.x ) * invQ;

				if ( NdotL > 0.0 ) {

					float phi = 2.0 * PI * Xi.y;
					float sinTheta = 2.0 * alpha * sqrt( Xi.x * ( 1.0 - Xi.x ) ) * invQ;
					vec3 L = N * NdotL + ( tangent * cos( phi ) + bitangent * sin( phi ) ) * sinTheta;

					// Match the source mip to the sample's solid angle. The terms
					// independent of the sample are precomputed in lodBias.
					float d = alpha2 * invQ;
					float lod = max( log2( d ) + lodBias, 0.0 );

					// Weight by NdotL for the split-sum approximation
					prefilteredColor += textureLod( envMap, L, lod ).rgb * NdotL;
					totalWeight += NdotL;

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function Hb(){return pl("PMREMGGXIntegration",{envMap:{value:null},roughness:{value:0},sourceLod:{value:0},sourceSize:{value:N0}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float sourceLod;
		uniform int sourceSize;

		void main() {

			vec3 N = normalize( vWorldDirection );

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			float texelSize = 2.0 / float( sourceSize );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			// Pair opposite texels: only the one in N's hemisphere contributes.
			for ( int face = 0; face < 3; face ++ ) {

				for ( int y = 0; y < sourceSize; y ++ ) {

					for ( int x = 0; x < sourceSize; x ++ ) {

						vec2 uv = ( vec2( x, y ) + 0.5 ) * texelSize - 1.0;
						vec3 texelDirection = face == 0 ? vec3( 1.0, uv ) : ( face == 1 ? vec3( uv.x, 1.0, uv.y ) : vec3( uv, 1.0 ) );

						float invDistance = inversesqrt( 1.0 + dot( uv, uv ) );
						float NdotL = dot( N, texelDirection );
						texelDirection *= NdotL < 0.0 ? - 1.0 : 1.0;
						NdotL = abs( NdotL ) * invDistance;

						// With V = N, NdotH squared is ( 1 + NdotL ) / 2. Common factors
						// in the GGX distribution and texel solid angle cancel when normalized.
						float d = 1.0 + alpha2 + ( alpha2 - 1.0 ) * NdotL;
						float weight = NdotL * invDistance * invDistance * invDistance / ( d * d );

						prefilteredColor += textureLod( envMap, texelDirection, sourceLod ).rgb * weight;
						totalWeight += weight;

					}

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function Wb(){return pl("PMREMSphericalGaussianBlur",{envMap:{value:null},sigma:{value:0}},`

		#define SAMPLES ${Bb}
		#define GOLDEN_ANGLE 2.39996322973

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float sigma;

		#include <common>

		void main() {

			vec3 outputDirection = normalize( vWorldDirection );

			vec3 up = abs( outputDirection.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, outputDirection ) );
			vec3 bitangent = cross( outputDirection, tangent );

			// Truncate the kernel at three standard deviations or at the antipode.
			float thetaMax = min( 3.0 * sigma, PI );
			float truncation = 1.0 - exp( - 0.5 * thetaMax * thetaMax / ( sigma * sigma ) );

			vec3 accumColor = vec3( 0.0 );
			float accumWeight = 0.0;

			for ( int i = 0; i < SAMPLES; i ++ ) {

				// Stratified inverse-CDF sampling of the Gaussian, placed on a golden-angle spiral.
				float stratum = ( float( i ) + 0.5 ) / float( SAMPLES );
				float theta = sigma * sqrt( - 2.0 * log( 1.0 - stratum * truncation ) );
				float phi = float( i ) * GOLDEN_ANGLE;

				vec3 offset = cos( phi ) * tangent + sin( phi ) * bitangent;
				vec3 sampleDirection = cos( theta ) * outputDirection + sin( theta ) * offset;

				// Correct the planar sample density to solid angle.
				float weight = sin( theta ) / theta;

				accumColor += weight * textureLod( envMap, sampleDirection, 0.0 ).rgb;
				accumWeight += weight;

			}

			gl_FragColor = vec4( accumColor / accumWeight, 1.0 );

		}
	`)}function f0(){return pl("PMREMEquirectangularToCubemap",{envMap:{value:null}},`

		varying vec3 vWorldDirection;

		uniform sampler2D envMap;

		#include <common>

		void main() {

			// Average four subpixel samples to preserve small, bright features.
			vec3 direction = normalize( vWorldDirection );
			vec3 dx = dFdx( direction ) * 0.25;
			vec3 dy = dFdy( direction ) * 0.25;

			vec3 color = textureLod( envMap, equirectUv( normalize( direction - dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction - dx + dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx + dy ) ), 0.0 ).rgb;
			gl_FragColor = vec4( color * 0.25, 1.0 );

		}
	`)}function d0(){return pl("PMREMCubemapToCubemap",{envMap:{value:null},flipEnvMap:{value:-1}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float flipEnvMap;

		void main() {

			gl_FragColor = vec4( textureCube( envMap, vec3( flipEnvMap * vWorldDirection.x, vWorldDirection.yz ) ).rgb, 1.0 );

		}
	`)}function Xb(i){let t=new WeakMap,e=new WeakMap,n=null;function s(h,d=!1){return h==null?null:d?o(h):r(h)}function r(h){if(h&&h.isTexture){let d=h.mapping;if(d===Xc||d===qc)if(t.has(h)){let g=t.get(h).texture;return a(g,h.mapping)}else{let g=h.image;if(g&&g.height>0){let v=new dl(g.height);return v.fromEquirectangularTexture(i,h),t.set(h,v),h.addEventListener("dispose",c),a(v.texture,h.mapping)}else return null}}return h}function o(h){if(h&&h.isTexture&&h.isPMREMTexture!==!0){let d=h.mapping,g=d===Xc||d===qc,v=d===Rr||d===No;if(g||v){let m=e.get(h),p=m!==void 0?m.texture.pmremVersion:0;if(h.isRenderTargetTexture&&h.pmremVersion!==p)return n===null&&(n=new Nh(i)),m=g?n.fromEquirectangular(h,m):n.fromCubemap(h,m),m.texture.pmremVersion=h.pmremVersion,e.set(h,m),m.texture;if(m!==void 0)return m.texture;{let _=h.image;return g&&_&&_.height>0||v&&_&&l(_)?(n===null&&(n=new Nh(i)),m=g?n.fromEquirectangular(h):n.fromCubemap(h),m.texture.pmremVersion=h.pmremVersion,e.set(h,m),h.addEventListener("dispose",f),m.texture):null}}}return h}function a(h,d){return d===Xc?h.mapping=Rr:d===qc&&(h.mapping=No),h}function l(h){let d=0,g=6;for(let v=0;v<g;v++)h[v]!==void 0&&d++;return d===g}function c(h){let d=h.target;d.removeEventListener("dispose",c);let g=t.get(d);g!==void 0&&(t.delete(d),g.dispose())}function f(h){let d=h.target;d.removeEventListener("dispose",f);let g=e.get(d);g!==void 0&&(e.delete(d),g.dispose())}function u(){t=new WeakMap,e=new WeakMap,n!==null&&(n.dispose(),n=null)}return{get:s,dispose:u}}function qb(i){let t={};function e(n){if(t[n]!==void 0)return t[n];let s=i.getExtension(n);return t[n]=s,s}return{has:function(n){return e(n)!==null},init:function(){e("EXT_color_buffer_float"),e("WEBGL_clip_cull_distance"),e("OES_texture_float_linear"),e("EXT_color_buffer_half_float"),e("WEBGL_multisampled_render_to_texture"),e("WEBGL_render_shared_exponent")},get:function(n){let s=e(n);return s===null&&Pa("WebGLRenderer: "+n+" extension not supported."),s}}}function Yb(i,t,e,n){let s={},r=new WeakMap,o=new FinalizationRegistry(g=>delete s[g]);function a(g){l(g.target)}function l(g){g.index!==null&&t.remove(g.index);for(let m in g.attributes)t.remove(g.attributes[m]);g.removeEventListener("dispose",a),delete s[g.id],o.unregister(g);let v=r.get(g);v&&(t.remove(v),r.delete(g)),n.releaseStatesOfGeometry(g),g.isInstancedBufferGeometry===!0&&delete g._maxInstanceCount,e.memory.geometries--}function c(g,v){return s[v.id]!==void 0||(v.addEventListener("dispose",a),s[v.id]=new WeakRef(v),o.register(v,v.id,v),e.memory.geometries++),v}function f(g){let v=g.attributes;for(let m in v)t.update(v[m],i.ARRAY_BUFFER)}function u(g){let v=g.index,m=g.attributes.position,p=0;if(m===void 0)return;let _=v!==null?v.array.length:m.array.length/3-1,M=m.count>=65535?ka:za,y=new M(Math.ceil(_/3)*6,1),w=y.array;if(v!==null){let x=v.array;p=v.version;for(let b=0,D=0;b<_;b+=3){let C=x[b+0],P=x[b+1],I=x[b+2];w[D++]=C,w[D++]=P,w[D++]=P,w[D++]=I,w[D++]=I,w[D++]=C}}else{p=m.version;for(let x=0,b=0;x<_;x+=3){let D=x+0,C=x+1,P=x+2;w[b++]=D,w[b++]=C,w[b++]=C,w[b++]=P,w[b++]=P,w[b++]=D}}y.version=p;let T=r.get(g);T&&t.remove(T),r.set(g,y)}function h(g){let v=r.get(g);if(v){let m=g.index;m!==null&&v.version<m.version&&u(g)}else u(g);return r.get(g)}function d(){for(let g in s){let v=s[g].deref();v!==void 0&&l(v)}}return{get:c,update:f,getWireframeAttribute:h,dispose:d}}function Zb(i,t,e){let n;function s(u){n=u}let r,o;function a(u){r=u.type,o=u.bytesPerElement}function l(u,h){i.drawElements(n,h,r,u*o),e.update(h,n,1)}function c(u,h,d){d!==0&&(i.drawElementsInstanced(n,h,r,u*o,d),e.update(h,n,d))}function f(u,h,d){if(d===0)return;t.get("WEBGL_multi_draw").multiDrawElementsWEBGL(n,h,0,r,u,0,d);let v=0;for(let m=0;m<d;m++)v+=h[m];e.update(v,n,1)}this.setMode=s,this.setIndex=a,this.render=l,this.renderInstances=c,this.renderMultiDraw=f}function $b(i){let t={geometries:0,textures:0},e={frame:0,calls:0,triangles:0,points:0,lines:0};function n(r,o,a){switch(e.calls++,o){case i.TRIANGLES:e.triangles+=a*(r/3);break;case i.LINES:e.lines+=a*(r/2);break;case i.LINE_STRIP:e.lines+=a*(r-1);break;case i.LINE_LOOP:e.lines+=a*r;break;case i.POINTS:e.points+=a*r;break;default:Qt("WebGLInfo: Unknown draw mode:",o);break}}function s(){e.calls=0,e.triangles=0,e.points=0,e.lines=0}return{memory:t,render:e,programs:null,autoReset:!0,reset:s,update:n}}function Kb(i,t,e){let n=new WeakMap,s=new nn;function r(o,a,l){let c=o.morphTargetInfluences,f=a.morphAttributes.position||a.morphAttributes.normal||a.morphAttributes.color,u=f!==void 0?f.length:0,h=n.get(a);if(h===void 0||h.count!==u){let D=function(){x.dispose(),n.delete(a),a.removeEventListener("dispose",D)};h!==void 0&&h.texture.dispose();let d=a.morphAttributes.position!==void 0,g=a.morphAttributes.normal!==void 0,v=a.morphAttributes.color!==void 0,m=a.morphAttributes.position||[],p=a.morphAttributes.normal||[],_=a.morphAttributes.color||[],M=0;d===!0&&(M=1),g===!0&&(M=2),v===!0&&(M=3);let y=a.attributes.position.count*M,w=1;y>t.maxTextureSize&&(w=Math.ceil(y/t.maxTextureSize),y=t.maxTextureSize);let T=new Float32Array(y*w*4*u),x=new Oa(T,y,w,u);x.type=ui,x.needsUpdate=!0;let b=M*4;for(let C=0;C<u;C++){let P=m[C],I=p[C],O=_[C],L=y*w*4*C;for(let z=0;z<P.count;z++){let X=z*b;d===!0&&(s.fromBufferAttribute(P,z),T[L+X+0]=s.x,T[L+X+1]=s.y,T[L+X+2]=s.z,T[L+X+3]=0),g===!0&&(s.fromBufferAttribute(I,z),T[L+X+4]=s.x,T[L+X+5]=s.y,T[L+X+6]=s.z,T[L+X+7]=0),v===!0&&(s.fromBufferAttribute(O,z),T[L+X+8]=s.x,T[L+X+9]=s.y,T[L+X+10]=s.z,T[L+X+11]=O.itemSize===4?s.w:1)}}h={count:u,texture:x,size:new kt(y,w)},n.set(a,h),a.addEventListener("dispose",D)}if(o.isInstancedMesh===!0&&o.morphTexture!==null)l.getUniforms().setValue(i,"morphTexture",o.morphTexture,e);else{let d=0;for(let v=0;v<c.length;v++)d+=c[v];let g=a.morphTargetsRelative?1:1-d;l.getUniforms().setValue(i,"morphTargetBaseInfluence",g),l.getUniforms().setValue(i,"morphTargetInfluences",c)}l.getUniforms().setValue(i,"morphTargetsTexture",h.texture,e),l.getUniforms().setValue(i,"morphTargetsTextureSize",h.size)}return{update:r}}function Jb(i,t,e,n,s){let r=new WeakMap;function o(c){let f=s.render.frame,u=c.geometry,h=t.get(c,u);if(r.get(h)!==f&&(t.update(h),r.set(h,f)),c.isInstancedMesh&&(c.hasEventListener("dispose",l)===!1&&c.addEventListener("dispose",l),r.get(c)!==f&&(e.update(c.instanceMatrix,i.ARRAY_BUFFER),c.instanceColor!==null&&e.update(c.instanceColor,i.ARRAY_BUFFER),r.set(c,f))),c.isSkinnedMesh){let d=c.skeleton;r.get(d)!==f&&(d.update(),r.set(d,f))}return h}function a(){r=new WeakMap}function l(c){let f=c.target;f.removeEventListener("dispose",l),n.releaseStatesOfObject(f),e.remove(f.instanceMatrix),f.instanceColor!==null&&e.remove(f.instanceColor)}return{update:o,dispose:a}}var jb={[ud]:"LINEAR_TONE_MAPPING",[fd]:"REINHARD_TONE_MAPPING",[dd]:"CINEON_TONE_MAPPING",[pd]:"ACES_FILMIC_TONE_MAPPING",[gd]:"AGX_TONE_MAPPING",[_d]:"NEUTRAL_TONE_MAPPING",[md]:"CUSTOM_TONE_MAPPING"};function Qb(i,t,e,n,s,r){let o=new vi(t,e,{type:i,depthBuffer:s,stencilBuffer:r,samples:n?4:0,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,resolveDepthBuffer:!1,resolveStencilBuffer:!1}),a=null,l=null,c=null,f=new pn;f.setAttribute("position",new Xe([-1,3,0,-1,-1,0,3,-1,0],3)),f.setAttribute("uv",new Xe([0,2,0,0,2,0],2));let u=new Rc({uniforms:{tDiffuse:{value:null}},vertexShader:`
			precision highp float;

			uniform mat4 modelViewMatrix;
			uniform mat4 projectionMatrix;

			attribute vec3 position;
			attribute vec2 uv;

			varying vec2 vUv;

			void main() {
				vUv = uv;
				gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
			}`,fragmentShader:`
			precision highp float;

			uniform sampler2D tDiffuse;

			varying vec2 vUv;

			#include <tonemapping_pars_fragment>
			#include <colorspace_pars_fragment>

			void main() {
				gl_FragColor = texture2D( tDiffuse, vUv );

				#ifdef LINEAR_TONE_MAPPING
					gl_FragColor.rgb = LinearToneMapping( gl_FragColor.rgb );
				#elif defined( REINHARD_TONE_MAPPING )
					gl_FragColor.rgb = ReinhardToneMapping( gl_FragColor.rgb );
				#elif defined( CINEON_TONE_MAPPING )
					gl_FragColor.rgb = CineonToneMapping( gl_FragColor.rgb );
				#elif defined( ACES_FILMIC_TONE_MAPPING )
					gl_FragColor.rgb = ACESFilmicToneMapping( gl_FragColor.rgb );
				#elif defined( AGX_TONE_MAPPING )
					gl_FragColor.rgb = AgXToneMapping( gl_FragColor.rgb );
				#elif defined( NEUTRAL_TONE_MAPPING )
					gl_FragColor.rgb = NeutralToneMapping( gl_FragColor.rgb );
				#elif defined( CUSTOM_TONE_MAPPING )
					gl_FragColor.rgb = CustomToneMapping( gl_FragColor.rgb );
				#endif

				#ifdef SRGB_TRANSFER
					gl_FragColor = sRGBTransferOETF( gl_FragColor );
				#endif
			}`,depthTest:!1,depthWrite:!1}),h=new En(f,u),d=new ja(-1,1,1,-1,0,1),g=null,v=null,m=!1,p,_=null,M=[],y=!1;this.setSize=function(w,T){o.setSize(w,T),a!==null&&a.setSize(w,T),l!==null&&l.setSize(w,T);for(let x=0;x<M.length;x++){let b=M[x];b.setSize&&b.setSize(w,T)}},this.setEffects=function(w){M=w,y=M.length>0&&M[0].isRenderPass===!0;let T=o.width,x=o.height;M.length>0&&a===null&&(a=new vi(T,x,{type:Wi,depthBuffer:!1,stencilBuffer:!1}),l=new vi(T,x,{type:Wi,depthBuffer:!1,stencilBuffer:!1}));let b=s===!0&&M.some(D=>D.needsDepthTexture===!0);b!==(o.depthTexture!==null)&&(b===!0&&c===null&&(c=new Ds(T,x),r===!0&&(c.format=Us,c.type=Pr)),o.dispose(),o.depthTexture=b?c:null,o.resolveDepthBuffer=b,o.storeMultisampledDepthBuffer=b);for(let D=0;D<M.length;D++){let C=M[D];C.setSize&&C.setSize(T,x),b&&C.needsDepthTexture===!0&&C.setDepthTexture&&C.setDepthTexture(c)}},this.begin=function(w,T){if(m||w.toneMapping===hs&&M.length===0)return!1;if(_=T,T!==null){let x=T.width,b=T.height;(o.width!==x||o.height!==b)&&this.setSize(x,b)}return y===!1&&w.setRenderTarget(o),p=w.toneMapping,w.toneMapping=hs,!0},this.hasRenderPass=function(){return y},this.end=function(w,T){w.toneMapping=p,m=!0;let x=o,b=a;for(let D=0;D<M.length;D++){let C=M[D];C.enabled!==!1&&(C.render(w,b,x,T),C.needsSwap!==!1&&(x=b,b=b===a?l:a))}if(g!==w.outputColorSpace||v!==w.toneMapping){g=w.outputColorSpace,v=w.toneMapping,u.defines={},xe.getTransfer(g)===Re&&(u.defines.SRGB_TRANSFER="");let D=jb[v];D&&(u.defines[D]=""),u.needsUpdate=!0}u.uniforms.tDiffuse.value=x.texture,w.setRenderTarget(_),w.render(h,d),_=null,m=!1},this.isCompositing=function(){return m},this.dispose=function(){o.dispose(),a!==null&&a.dispose(),l!==null&&l.dispose(),f.dispose(),u.dispose()}}var U0=new ci,F0=new Ds(1,1),O0=new Wa(1),B0=new Oa,z0=new Tc,k0=new Ha,p0=[],m0=[],g0=new Float32Array(16),_0=new Float32Array(9),x0=new Float32Array(4);function ko(i,t,e){let n=i[0];if(n<=0||n>0)return i;let s=t*e,r=p0[s];if(r===void 0&&(r=new Float32Array(s),p0[s]=r),t!==0){n.toArray(r,0);for(let o=1,a=0;o!==t;++o)a+=e,i[o].toArray(r,a)}return r}function Rn(i,t){if(i.length!==t.length)return!1;for(let e=0,n=i.length;e<n;e++)if(i[e]!==t[e])return!1;return!0}function Pn(i,t){for(let e=0,n=t.length;e<n;e++)i[e]=t[e]}function Oh(i,t){let e=m0[t];e===void 0&&(e=new Int32Array(t),m0[t]=e);for(let n=0;n!==t;++n)e[n]=i.allocateTextureUnit();return e}function tw(i,t){let e=this.cache;e[0]!==t&&(i.uniform1f(this.addr,t),e[0]=t)}function ew(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(i.uniform2f(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(Rn(e,t))return;i.uniform2fv(this.addr,t),Pn(e,t)}}function nw(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(i.uniform3f(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else if(t.r!==void 0)(e[0]!==t.r||e[1]!==t.g||e[2]!==t.b)&&(i.uniform3f(this.addr,t.r,t.g,t.b),e[0]=t.r,e[1]=t.g,e[2]=t.b);else{if(Rn(e,t))return;i.uniform3fv(this.addr,t),Pn(e,t)}}function iw(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(i.uniform4f(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(Rn(e,t))return;i.uniform4fv(this.addr,t),Pn(e,t)}}function sw(i,t){let e=this.cache,n=t.elements;if(n===void 0){if(Rn(e,t))return;i.uniformMatrix2fv(this.addr,!1,t),Pn(e,t)}else{if(Rn(e,n))return;x0.set(n),i.uniformMatrix2fv(this.addr,!1,x0),Pn(e,n)}}function rw(i,t){let e=this.cache,n=t.elements;if(n===void 0){if(Rn(e,t))return;i.uniformMatrix3fv(this.addr,!1,t),Pn(e,t)}else{if(Rn(e,n))return;_0.set(n),i.uniformMatrix3fv(this.addr,!1,_0),Pn(e,n)}}function ow(i,t){let e=this.cache,n=t.elements;if(n===void 0){if(Rn(e,t))return;i.uniformMatrix4fv(this.addr,!1,t),Pn(e,t)}else{if(Rn(e,n))return;g0.set(n),i.uniformMatrix4fv(this.addr,!1,g0),Pn(e,n)}}function aw(i,t){let e=this.cache;e[0]!==t&&(i.uniform1i(this.addr,t),e[0]=t)}function lw(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(i.uniform2i(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(Rn(e,t))return;i.uniform2iv(this.addr,t),Pn(e,t)}}function cw(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(i.uniform3i(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else{if(Rn(e,t))return;i.uniform3iv(this.addr,t),Pn(e,t)}}function hw(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(i.uniform4i(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(Rn(e,t))return;i.uniform4iv(this.addr,t),Pn(e,t)}}function uw(i,t){let e=this.cache;e[0]!==t&&(i.uniform1ui(this.addr,t),e[0]=t)}function fw(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(i.uniform2ui(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(Rn(e,t))return;i.uniform2uiv(this.addr,t),Pn(e,t)}}function dw(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(i.uniform3ui(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else{if(Rn(e,t))return;i.uniform3uiv(this.addr,t),Pn(e,t)}}function pw(i,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(i.uniform4ui(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(Rn(e,t))return;i.uniform4uiv(this.addr,t),Pn(e,t)}}function Bh(i){return i.version===0&&(i.compareFunction=Pd,i.needsUpdate=!0),i}function mw(i,t,e){let n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s);let r;this.type===i.SAMPLER_2D_SHADOW?r=Bh(F0):r=U0,e.setTexture2D(t||r,s)}function gw(i,t,e){let n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),e.setTexture3D(t||z0,s)}function _w(i,t,e){let n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s);let r;this.type===i.SAMPLER_CUBE_SHADOW?r=Bh(O0):r=k0,e.setTextureCube(t||r,s)}function xw(i,t,e){let n=this.cache,s=e.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),e.setTexture2DArray(t||B0,s)}function yw(i){switch(i){case 5126:return tw;case 35664:return ew;case 35665:return nw;case 35666:return iw;case 35674:return sw;case 35675:return rw;case 35676:return ow;case 5124:case 35670:return aw;case 35667:case 35671:return lw;case 35668:case 35672:return cw;case 35669:case 35673:return hw;case 5125:return uw;case 36294:return fw;case 36295:return dw;case 36296:return pw;case 35678:case 36198:case 36298:case 36306:case 35682:return mw;case 35679:case 36299:case 36307:return gw;case 35680:case 36300:case 36308:case 36293:return _w;case 36289:case 36303:case 36311:case 36292:return xw}}function vw(i,t){i.uniform1fv(this.addr,t)}function Sw(i,t){let e=ko(t,this.size,2);i.uniform2fv(this.addr,e)}function Mw(i,t){let e=ko(t,this.size,3);i.uniform3fv(this.addr,e)}function bw(i,t){let e=ko(t,this.size,4);i.uniform4fv(this.addr,e)}function ww(i,t){let e=ko(t,this.size,4);i.uniformMatrix2fv(this.addr,!1,e)}function Tw(i,t){let e=ko(t,this.size,9);i.uniformMatrix3fv(this.addr,!1,e)}function Aw(i,t){let e=ko(t,this.size,16);i.uniformMatrix4fv(this.addr,!1,e)}function Ew(i,t){i.uniform1iv(this.addr,t)}function Cw(i,t){i.uniform2iv(this.addr,t)}function Rw(i,t){i.uniform3iv(this.addr,t)}function Pw(i,t){i.uniform4iv(this.addr,t)}function Iw(i,t){i.uniform1uiv(this.addr,t)}function Lw(i,t){i.uniform2uiv(this.addr,t)}function Dw(i,t){i.uniform3uiv(this.addr,t)}function Nw(i,t){i.uniform4uiv(this.addr,t)}function Uw(i,t,e){let n=this.cache,s=t.length,r=Oh(e,s);Rn(n,r)||(i.uniform1iv(this.addr,r),Pn(n,r));let o;this.type===i.SAMPLER_2D_SHADOW?o=Bh(F0):o=U0;for(let a=0;a!==s;++a)e.setTexture2D(t[a]||o,r[a])}function Fw(i,t,e){let n=this.cache,s=t.length,r=Oh(e,s);Rn(n,r)||(i.uniform1iv(this.addr,r),Pn(n,r));for(let o=0;o!==s;++o)e.setTexture3D(t[o]||z0,r[o])}function Ow(i,t,e){let n=this.cache,s=t.length,r=Oh(e,s);Rn(n,r)||(i.uniform1iv(this.addr,r),Pn(n,r));let o;this.type===i.SAMPLER_CUBE_SHADOW?o=Bh(O0):o=k0;for(let a=0;a!==s;++a)e.setTextureCube(t[a]||o,r[a])}function Bw(i,t,e){let n=this.cache,s=t.length,r=Oh(e,s);Rn(n,r)||(i.uniform1iv(this.addr,r),Pn(n,r));for(let o=0;o!==s;++o)e.setTexture2DArray(t[o]||B0,r[o])}function zw(i){switch(i){case 5126:return vw;case 35664:return Sw;case 35665:return Mw;case 35666:return bw;case 35674:return ww;case 35675:return Tw;case 35676:return Aw;case 5124:case 35670:return Ew;case 35667:case 35671:return Cw;case 35668:case 35672:return Rw;case 35669:case 35673:return Pw;case 5125:return Iw;case 36294:return Lw;case 36295:return Dw;case 36296:return Nw;case 35678:case 36198:case 36298:case 36306:case 35682:return Uw;case 35679:case 36299:case 36307:return Fw;case 35680:case 36300:case 36308:case 36293:return Ow;case 36289:case 36303:case 36311:case 36292:return Bw}}var Zd=class{constructor(t,e,n){this.id=t,this.addr=n,this.cache=[],this.type=e.type,this.setValue=yw(e.type)}},$d=class{constructor(t,e,n){this.id=t,this.addr=n,this.cache=[],this.type=e.type,this.size=e.size,this.setValue=zw(e.type)}},Kd=class{constructor(t){this.id=t,this.seq=[],this.map={}}setValue(t,e,n){let s=this.seq;for(let r=0,o=s.length;r!==o;++r){let a=s[r];a.setValue(t,e[a.id],n)}}},qd=/(\w+)(\])?(\[|\.)?/g;function y0(i,t){i.seq.push(t),i.map[t.id]=t}function kw(i,t,e){let n=i.name,s=n.length;for(qd.lastIndex=0;;){let r=qd.exec(n),o=qd.lastIndex,a=r[1],l=r[2]==="]",c=r[3];if(l&&(a=a|0),c===void 0||c==="["&&o+2===s){y0(e,c===void 0?new Zd(a,i,t):new $d(a,i,t));break}else{let u=e.map[a];u===void 0&&(u=new Kd(a),y0(e,u)),e=u}}}var zo=class{constructor(t,e){this.seq=[],this.map={};let n=t.getProgramParameter(e,t.ACTIVE_UNIFORMS);for(let o=0;o<n;++o){let a=t.getActiveUniform(e,o),l=t.getUniformLocation(e,a.name);kw(a,l,this)}let s=[],r=[];for(let o of this.seq)o.type===t.SAMPLER_2D_SHADOW||o.type===t.SAMPLER_CUBE_SHADOW||o.type===t.SAMPLER_2D_ARRAY_SHADOW?s.push(o):r.push(o);s.length>0&&(this.seq=s.concat(r))}setValue(t,e,n,s){let r=this.map[e];r!==void 0&&r.setValue(t,n,s)}setOptional(t,e,n){let s=e[n];s!==void 0&&this.setValue(t,n,s)}static upload(t,e,n,s){for(let r=0,o=e.length;r!==o;++r){let a=e[r],l=n[a.id];l.needsUpdate!==!1&&a.setValue(t,l.value,s)}}static seqWithValue(t,e){let n=[];for(let s=0,r=t.length;s!==r;++s){let o=t[s];o.id in e&&n.push(o)}return n}};function v0(i,t,e){let n=i.createShader(t);return i.shaderSource(n,e),i.compileShader(n),n}var Vw=37297,Gw=0;function Hw(i,t){let e=i.split(`
`),n=[],s=Math.max(t-6,0),r=Math.min(t+6,e.length);for(let o=s;o<r;o++){let a=o+1;n.push(`${a===t?">":" "} ${a}: ${e[o]}`)}return n.join(`
`)}var S0=new ie;function Ww(i){xe._getMatrix(S0,xe.workingColorSpace,i);let t=`mat3( ${S0.elements.map(e=>e.toFixed(4))} )`;switch(xe.getTransfer(i)){case Ua:return[t,"LinearTransferOETF"];case Re:return[t,"sRGBTransferOETF"];default:return Yt("WebGLProgram: Unsupported color space: ",i),[t,"LinearTransferOETF"]}}function M0(i,t,e){let n=i.getShaderParameter(t,i.COMPILE_STATUS),r=(i.getShaderInfoLog(t)||"").trim();if(n&&r==="")return"";let o=/ERROR: 0:(\d+)/.exec(r);if(o){let a=parseInt(o[1]);return e.toUpperCase()+`

`+r+`

`+Hw(i.getShaderSource(t),a)}else return r}function Xw(i,t){let e=Ww(t);return[`vec4 ${i}( vec4 value ) {`,`	return ${e[1]}( vec4( ${e[0]} * value.rgb, value.a ) );`,"}"].join(`
`)}var qw={[ud]:"Linear",[fd]:"Reinhard",[dd]:"Cineon",[pd]:"ACESFilmic",[gd]:"AgX",[_d]:"Neutral",[md]:"Custom"};function Yw(i,t){let e=qw[t];return e===void 0?(Yt("WebGLProgram: Unsupported toneMapping:",t),"vec3 "+i+"( vec3 color ) { return LinearToneMapping( color ); }"):"vec3 "+i+"( vec3 color ) { return "+e+"ToneMapping( color ); }"}var Dh=new U;function Zw(){xe.getLuminanceCoefficients(Dh);let i=Dh.x.toFixed(4),t=Dh.y.toFixed(4),e=Dh.z.toFixed(4);return["float luminance( const in vec3 rgb ) {",`	const vec3 weights = vec3( ${i}, ${t}, ${e} );`,"	return dot( weights, rgb );","}"].join(`
`)}function $w(i){return[i.extensionClipCullDistance?"#extension GL_ANGLE_clip_cull_distance : require":"",i.extensionMultiDraw?"#extension GL_ANGLE_multi_draw : require":""].filter(fl).join(`
`)}function Kw(i){let t=[];for(let e in i){let n=i[e];n!==!1&&t.push("#define "+e+" "+n)}return t.join(`
`)}function Jw(i,t){let e={},n=i.getProgramParameter(t,i.ACTIVE_ATTRIBUTES);for(let s=0;s<n;s++){let r=i.getActiveAttrib(t,s),o=r.name,a=1;r.type===i.FLOAT_MAT2&&(a=2),r.type===i.FLOAT_MAT3&&(a=3),r.type===i.FLOAT_MAT4&&(a=4),e[o]={type:r.type,location:i.getAttribLocation(t,o),locationSize:a}}return e}function fl(i){return i!==""}function b0(i,t){let e=t.numSpotLightShadows+t.numSpotLightMaps-t.numSpotLightShadowsWithMaps;return i.replace(/NUM_SUN_LIGHTS/g,t.numSunLights).replace(/NUM_DIR_LIGHTS/g,t.numDirLights).replace(/NUM_SPOT_LIGHTS/g,t.numSpotLights).replace(/NUM_SPOT_LIGHT_MAPS/g,t.numSpotLightMaps).replace(/NUM_SPOT_LIGHT_COORDS/g,e).replace(/NUM_RECT_AREA_LIGHTS/g,t.numRectAreaLights).replace(/NUM_POINT_LIGHTS/g,t.numPointLights).replace(/NUM_HEMI_LIGHTS/g,t.numHemiLights).replace(/NUM_SUN_LIGHT_SHADOWS/g,t.numSunLightShadows).replace(/NUM_DIR_LIGHT_SHADOWS/g,t.numDirLightShadows).replace(/NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS/g,t.numSpotLightShadowsWithMaps).replace(/NUM_SPOT_LIGHT_SHADOWS/g,t.numSpotLightShadows).replace(/NUM_POINT_LIGHT_SHADOWS/g,t.numPointLightShadows).replace(/NUM_LIGHT_PROBE_GRIDS/g,t.numLightProbeGrids)}function w0(i,t){return i.replace(/NUM_CLIPPING_PLANES/g,t.numClippingPlanes).replace(/UNION_CLIPPING_PLANES/g,t.numClippingPlanes-t.numClipIntersection)}var jw=/^[ \t]*#include +<([\w\d./]+)>/gm;function Jd(i){return i.replace(jw,Qw)}function Qw(i,t){let e=fe[t];if(e===void 0)throw new Error("THREE.WebGLProgram: Can not resolve #include <"+t+">");return Jd(e)}var t1=/#pragma unroll_loop_start\s+for\s*\(\s*int\s+i\s*=\s*(\d+)\s*;\s*i\s*<\s*(\d+)\s*;\s*i\s*\+\+\s*\)\s*{([\s\S]+?)}\s+#pragma unroll_loop_end/g;function T0(i){return i.replace(t1,e1)}function e1(i,t,e,n){let s="";for(let r=parseInt(t);r<parseInt(e);r++)s+=n.replace(/\[\s*i\s*\]/g,"[ "+r+" ]").replace(/UNROLLED_LOOP_INDEX/g,r);return s}function A0(i){let t=`precision ${i.precision} float;
	precision ${i.precision} int;
	precision ${i.precision} sampler2D;
	precision ${i.precision} samplerCube;
	precision ${i.precision} sampler3D;
	precision ${i.precision} sampler2DArray;
	precision ${i.precision} sampler2DShadow;
	precision ${i.precision} samplerCubeShadow;
	precision ${i.precision} sampler2DArrayShadow;
	precision ${i.precision} isampler2D;
	precision ${i.precision} isampler3D;
	precision ${i.precision} isamplerCube;
	precision ${i.precision} isampler2DArray;
	precision ${i.precision} usampler2D;
	precision ${i.precision} usampler3D;
	precision ${i.precision} usamplerCube;
	precision ${i.precision} usampler2DArray;
	`;return i.precision==="highp"?t+=`
#define HIGH_PRECISION`:i.precision==="mediump"?t+=`
#define MEDIUM_PRECISION`:i.precision==="lowp"&&(t+=`
#define LOW_PRECISION`),t}var n1={[il]:"SHADOWMAP_TYPE_PCF",[Lo]:"SHADOWMAP_TYPE_VSM"};function i1(i){return n1[i.shadowMapType]||"SHADOWMAP_TYPE_BASIC"}var s1={[No]:"ENVMAP_MODE_REFRACTION"};function r1(i){return i.envMap===!1?"ENVMAP_MODE_REFLECTION":s1[i.envMapMode]||"ENVMAP_MODE_REFLECTION"}var o1={[hd]:"ENVMAP_BLENDING_MULTIPLY",[Hg]:"ENVMAP_BLENDING_MIX",[Wg]:"ENVMAP_BLENDING_ADD"};function a1(i){return i.envMap===!1?"ENVMAP_BLENDING_NONE":o1[i.combine]||"ENVMAP_BLENDING_NONE"}function l1(i,t,e,n){let s=i.getContext(),r=e.defines,o=e.vertexShader,a=e.fragmentShader,l=i1(e),c=e.envMapPMREM===!0?"ENVMAP_TYPE_PMREM":"ENVMAP_TYPE_CUBE",f=r1(e),u=a1(e),h=$w(e),d=Kw(r),g=s.createProgram(),v,m,p=e.glslVersion?"#version "+e.glslVersion+`
`:"";e.isRawShaderMaterial?(v=["#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,d].filter(fl).join(`
`),v.length>0&&(v+=`
`),m=["#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,d].filter(fl).join(`
`),m.length>0&&(m+=`
`)):(v=[A0(e),"#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,d,e.extensionClipCullDistance?"#define USE_CLIP_DISTANCE":"",e.batching?"#define USE_BATCHING":"",e.batchingColor?"#define USE_BATCHING_COLOR":"",e.instancing?"#define USE_INSTANCING":"",e.instancingColor?"#define USE_INSTANCING_COLOR":"",e.instancingMorph?"#define USE_INSTANCING_MORPH":"",e.useFog&&e.fog?"#define USE_FOG":"",e.useFog&&e.fogExp2?"#define FOG_EXP2":"",e.map?"#define USE_MAP":"",e.envMap?"#define USE_ENVMAP":"",e.envMap?"#define "+f:"",e.lightMap?"#define USE_LIGHTMAP":"",e.aoMap?"#define USE_AOMAP":"",e.bumpMap?"#define USE_BUMPMAP":"",e.normalMap?"#define USE_NORMALMAP":"",e.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",e.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",e.displacementMap?"#define USE_DISPLACEMENTMAP":"",e.emissiveMap?"#define USE_EMISSIVEMAP":"",e.anisotropy?"#define USE_ANISOTROPY":"",e.anisotropyMap?"#define USE_ANISOTROPYMAP":"",e.clearcoatMap?"#define USE_CLEARCOATMAP":"",e.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",e.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",e.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",e.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",e.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",e.specularMap?"#define USE_SPECULARMAP":"",e.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",e.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",e.roughnessMap?"#define USE_ROUGHNESSMAP":"",e.metalnessMap?"#define USE_METALNESSMAP":"",e.alphaMap?"#define USE_ALPHAMAP":"",e.alphaHash?"#define USE_ALPHAHASH":"",e.transmission?"#define USE_TRANSMISSION":"",e.transmissionMap?"#define USE_TRANSMISSIONMAP":"",e.thicknessMap?"#define USE_THICKNESSMAP":"",e.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",e.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",e.mapUv?"#define MAP_UV "+e.mapUv:"",e.alphaMapUv?"#define ALPHAMAP_UV "+e.alphaMapUv:"",e.lightMapUv?"#define LIGHTMAP_UV "+e.lightMapUv:"",e.aoMapUv?"#define AOMAP_UV "+e.aoMapUv:"",e.emissiveMapUv?"#define EMISSIVEMAP_UV "+e.emissiveMapUv:"",e.bumpMapUv?"#define BUMPMAP_UV "+e.bumpMapUv:"",e.normalMapUv?"#define NORMALMAP_UV "+e.normalMapUv:"",e.displacementMapUv?"#define DISPLACEMENTMAP_UV "+e.displacementMapUv:"",e.metalnessMapUv?"#define METALNESSMAP_UV "+e.metalnessMapUv:"",e.roughnessMapUv?"#define ROUGHNESSMAP_UV "+e.roughnessMapUv:"",e.anisotropyMapUv?"#define ANISOTROPYMAP_UV "+e.anisotropyMapUv:"",e.clearcoatMapUv?"#define CLEARCOATMAP_UV "+e.clearcoatMapUv:"",e.clearcoatNormalMapUv?"#define CLEARCOAT_NORMALMAP_UV "+e.clearcoatNormalMapUv:"",e.clearcoatRoughnessMapUv?"#define CLEARCOAT_ROUGHNESSMAP_UV "+e.clearcoatRoughnessMapUv:"",e.diffuseRoughnessMapUv?"#define DIFFUSE_ROUGHNESSMAP_UV "+e.diffuseRoughnessMapUv:"",e.iridescenceMapUv?"#define IRIDESCENCEMAP_UV "+e.iridescenceMapUv:"",e.iridescenceThicknessMapUv?"#define IRIDESCENCE_THICKNESSMAP_UV "+e.iridescenceThicknessMapUv:"",e.sheenColorMapUv?"#define SHEEN_COLORMAP_UV "+e.sheenColorMapUv:"",e.sheenRoughnessMapUv?"#define SHEEN_ROUGHNESSMAP_UV "+e.sheenRoughnessMapUv:"",e.specularMapUv?"#define SPECULARMAP_UV "+e.specularMapUv:"",e.specularColorMapUv?"#define SPECULAR_COLORMAP_UV "+e.specularColorMapUv:"",e.specularIntensityMapUv?"#define SPECULAR_INTENSITYMAP_UV "+e.specularIntensityMapUv:"",e.transmissionMapUv?"#define TRANSMISSIONMAP_UV "+e.transmissionMapUv:"",e.thicknessMapUv?"#define THICKNESSMAP_UV "+e.thicknessMapUv:"",e.vertexTangents&&e.flatShading===!1?"#define USE_TANGENT":"",e.vertexNormals?"#define HAS_NORMAL":"",e.vertexColors?"#define USE_COLOR":"",e.vertexAlphas?"#define USE_COLOR_ALPHA":"",e.vertexUv1s?"#define USE_UV1":"",e.vertexUv2s?"#define USE_UV2":"",e.vertexUv3s?"#define USE_UV3":"",e.pointsUvs?"#define USE_POINTS_UV":"",e.flatShading?"#define FLAT_SHADED":"",e.skinning?"#define USE_SKINNING":"",e.morphTargets?"#define USE_MORPHTARGETS":"",e.morphNormals&&e.flatShading===!1?"#define USE_MORPHNORMALS":"",e.morphColors?"#define USE_MORPHCOLORS":"",e.morphTargetsCount>0?"#define MORPHTARGETS_TEXTURE_STRIDE "+e.morphTextureStride:"",e.morphTargetsCount>0?"#define MORPHTARGETS_COUNT "+e.morphTargetsCount:"",e.doubleSided?"#define DOUBLE_SIDED":"",e.flipSided?"#define FLIP_SIDED":"",e.shadowMapEnabled?"#define USE_SHADOWMAP":"",e.shadowMapEnabled?"#define "+l:"",e.sizeAttenuation?"#define USE_SIZEATTENUATION":"",e.numLightProbes>0?"#define USE_LIGHT_PROBES":"",e.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",e.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 modelMatrix;","uniform mat4 modelViewMatrix;","uniform mat4 projectionMatrix;","uniform mat4 viewMatrix;","uniform mat3 normalMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;","#ifdef USE_INSTANCING","	attribute mat4 instanceMatrix;","#endif","#ifdef USE_INSTANCING_COLOR","	attribute vec3 instanceColor;","#endif","#ifdef USE_INSTANCING_MORPH","	uniform sampler2D morphTexture;","#endif","attribute vec3 position;","attribute vec3 normal;","attribute vec2 uv;","#ifdef USE_UV1","	attribute vec2 uv1;","#endif","#ifdef USE_UV2","	attribute vec2 uv2;","#endif","#ifdef USE_UV3","	attribute vec2 uv3;","#endif","#ifdef USE_TANGENT","	attribute vec4 tangent;","#endif","#if defined( USE_COLOR_ALPHA )","	attribute vec4 color;","#elif defined( USE_COLOR )","	attribute vec3 color;","#endif","#ifdef USE_SKINNING","	attribute vec4 skinIndex;","	attribute vec4 skinWeight;","#endif",`
`].filter(fl).join(`
`),m=[A0(e),"#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,d,e.useFog&&e.fog?"#define USE_FOG":"",e.useFog&&e.fogExp2?"#define FOG_EXP2":"",e.alphaToCoverage?"#define ALPHA_TO_COVERAGE":"",e.map?"#define USE_MAP":"",e.matcap?"#define USE_MATCAP":"",e.envMap?"#define USE_ENVMAP":"",e.envMap?"#define "+c:"",e.envMap?"#define "+f:"",e.envMap?"#define "+u:"",e.envMapPMREM?"#define ENVMAP_MAX_LOD "+e.envMapMaxLod+".0":"",e.envMapPMREM?"#define ENVMAP_SIZE "+e.envMapSize+".0":"",e.lightMap?"#define USE_LIGHTMAP":"",e.aoMap?"#define USE_AOMAP":"",e.bumpMap?"#define USE_BUMPMAP":"",e.normalMap?"#define USE_NORMALMAP":"",e.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",e.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",e.packedNormalMap?"#define USE_PACKED_NORMALMAP":"",e.emissiveMap?"#define USE_EMISSIVEMAP":"",e.anisotropy?"#define USE_ANISOTROPY":"",e.anisotropyMap?"#define USE_ANISOTROPYMAP":"",e.clearcoat?"#define USE_CLEARCOAT":"",e.clearcoatMap?"#define USE_CLEARCOATMAP":"",e.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",e.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",e.diffuseRoughness?"#define USE_DIFFUSE_ROUGHNESS":"",e.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",e.dispersion?"#define USE_DISPERSION":"",e.retroreflection?"#define USE_RETROREFLECTION":"",e.iridescence?"#define USE_IRIDESCENCE":"",e.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",e.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",e.specularMap?"#define USE_SPECULARMAP":"",e.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",e.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",e.roughnessMap?"#define USE_ROUGHNESSMAP":"",e.metalnessMap?"#define USE_METALNESSMAP":"",e.alphaMap?"#define USE_ALPHAMAP":"",e.alphaTest?"#define USE_ALPHATEST":"",e.alphaHash?"#define USE_ALPHAHASH":"",e.sheen?"#define USE_SHEEN":"",e.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",e.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",e.transmission?"#define USE_TRANSMISSION":"",e.transmissionMap?"#define USE_TRANSMISSIONMAP":"",e.thicknessMap?"#define USE_THICKNESSMAP":"",e.vertexTangents&&e.flatShading===!1?"#define USE_TANGENT":"",e.vertexColors||e.instancingColor?"#define USE_COLOR":"",e.vertexAlphas||e.batchingColor?"#define USE_COLOR_ALPHA":"",e.vertexUv1s?"#define USE_UV1":"",e.vertexUv2s?"#define USE_UV2":"",e.vertexUv3s?"#define USE_UV3":"",e.pointsUvs?"#define USE_POINTS_UV":"",e.gradientMap?"#define USE_GRADIENTMAP":"",e.flatShading?"#define FLAT_SHADED":"",e.doubleSided?"#define DOUBLE_SIDED":"",e.flipSided?"#define FLIP_SIDED":"",e.shadowMapEnabled?"#define USE_SHADOWMAP":"",e.shadowMapEnabled?"#define "+l:"",e.premultipliedAlpha?"#define PREMULTIPLIED_ALPHA":"",e.numLightProbes>0?"#define USE_LIGHT_PROBES":"",e.decodeVideoTexture?"#define DECODE_VIDEO_TEXTURE":"",e.decodeVideoTextureEmissive?"#define DECODE_VIDEO_TEXTURE_EMISSIVE":"",e.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",e.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 viewMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;",e.toneMapping!==hs?"#define TONE_MAPPING":"",e.toneMapping!==hs?fe.tonemapping_pars_fragment:"",e.toneMapping!==hs?Yw("toneMapping",e.toneMapping):"",e.dithering?"#define DITHERING":"",e.opaque?"#define OPAQUE":"",fe.colorspace_pars_fragment,Xw("linearToOutputTexel",e.outputColorSpace),Zw(),e.useDepthPacking?"#define DEPTH_PACKING "+e.depthPacking:"",`
`].filter(fl).join(`
`)),o=Jd(o),o=b0(o,e),o=w0(o,e),a=Jd(a),a=b0(a,e),a=w0(a,e),o=T0(o),a=T0(a),e.isRawShaderMaterial!==!0&&(p=`#version 300 es
`,v=[h,"#define attribute in","#define varying out","#define texture2D texture"].join(`
`)+`
`+v,m=["#define varying in",e.glslVersion===Id?"":"layout(location = 0) out highp vec4 pc_fragColor;",e.glslVersion===Id?"":"#define gl_FragColor pc_fragColor","#define gl_FragDepthEXT gl_FragDepth","#define texture2D texture","#define textureCube texture","#define texture2DProj textureProj","#define texture2DLodEXT textureLod","#define texture2DProjLodEXT textureProjLod","#define textureCubeLodEXT textureLod","#define texture2DGradEXT textureGrad","#define texture2DProjGradEXT textureProjGrad","#define textureCubeGradEXT textureGrad"].join(`
`)+`
`+m);let _=p+v+o,M=p+m+a,y=v0(s,s.VERTEX_SHADER,_),w=v0(s,s.FRAGMENT_SHADER,M);s.attachShader(g,y),s.attachShader(g,w),e.index0AttributeName!==void 0?s.bindAttribLocation(g,0,e.index0AttributeName):e.hasPositionAttribute===!0&&s.bindAttribLocation(g,0,"position"),s.linkProgram(g);function T(C){if(i.debug.checkShaderErrors){let P=s.getProgramInfoLog(g)||"",I=s.getShaderInfoLog(y)||"",O=s.getShaderInfoLog(w)||"",L=P.trim(),z=I.trim(),X=O.trim(),H=!0,at=!0;if(s.getProgramParameter(g,s.LINK_STATUS)===!1)if(H=!1,typeof i.debug.onShaderError=="function")i.debug.onShaderError(s,g,y,w);else{let Z=M0(s,y,"vertex"),j=M0(s,w,"fragment");Qt("WebGLProgram: Shader Error "+s.getError()+" - VALIDATE_STATUS "+s.getProgramParameter(g,s.VALIDATE_STATUS)+`

Material Name: `+C.name+`
Material Type: `+C.type+`

Program Info Log: `+L+`
`+Z+`
`+j)}else L!==""?Yt("WebGLProgram: Program Info Log:",L):(z===""||X==="")&&(at=!1);at&&(C.diagnostics={runnable:H,programLog:L,vertexShader:{log:z,prefix:v},fragmentShader:{log:X,prefix:m}})}s.deleteShader(y),s.deleteShader(w),x=new zo(s,g),b=Jw(s,g)}let x;this.getUniforms=function(){return x===void 0&&T(this),x};let b;this.getAttributes=function(){return b===void 0&&T(this),b};let D=e.rendererExtensionParallelShaderCompile===!1;return this.isReady=function(){return D===!1&&(D=s.getProgramParameter(g,Vw)),D},this.destroy=function(){n.releaseStatesOfProgram(this),s.deleteProgram(g),this.program=void 0},this.type=e.shaderType,this.name=e.shaderName,this.id=Gw++,this.cacheKey=t,this.usedTimes=1,this.program=g,this.vertexShader=y,this.fragmentShader=w,this}var c1=0,jd=class{constructor(){this.shaderCache=new Map,this.materialCache=new Map}update(t,e,n){let s=this._getShaderCacheForMaterial(t);return s.has(e)===!1&&(s.add(e),e.usedTimes++),s.has(n)===!1&&(s.add(n),n.usedTimes++),this}remove(t){let e=this.materialCache.get(t);for(let n of e)n.usedTimes--,n.usedTimes===0&&this.shaderCache.delete(n.code);return this.materialCache.delete(t),this}getVertexShaderStage(t){return this._getShaderStage(t.vertexShader)}getFragmentShaderStage(t){return this._getShaderStage(t.fragmentShader)}dispose(){this.shaderCache.clear(),this.materialCache.clear()}_getShaderCacheForMaterial(t){let e=this.materialCache,n=e.get(t);return n===void 0&&(n=new Set,e.set(t,n)),n}_getShaderStage(t){let e=this.shaderCache,n=e.get(t);return n===void 0&&(n=new Qd(t),e.set(t,n)),n}},Qd=class{constructor(t){this.id=c1++,this.code=t,this.usedTimes=0}};function h1(i){return i===rr||i===cl||i===hl}function u1(i,t,e,n,s,r){let o=new To,a=new jd,l=new Set,c=[],f=new Map,u=n.logarithmicDepthBuffer,h={MeshDepthMaterial:"depth",MeshDistanceMaterial:"distance",MeshNormalMaterial:"normal",MeshBasicMaterial:"basic",MeshLambertMaterial:"lambert",MeshPhongMaterial:"phong",MeshToonMaterial:"toon",MeshStandardMaterial:"physical",MeshPhysicalMaterial:"physical",MeshMatcapMaterial:"matcap",LineBasicMaterial:"basic",LineDashedMaterial:"dashed",PointsMaterial:"points",ShadowMaterial:"shadow",SpriteMaterial:"sprite"};function d(x){return l.add(x),x===0?"uv":`uv${x}`}function g(x,b,D,C,P,I){let O=C.fog,L=P.geometry,z=x.isMeshStandardMaterial||x.isMeshLambertMaterial||x.isMeshPhongMaterial?C.environment:null,X=x.isMeshStandardMaterial||x.isMeshLambertMaterial&&!x.envMap||x.isMeshPhongMaterial&&!x.envMap,H=t.get(x.envMap||z,X),at=h[x.type],Z=n.precision;x.precision!==null&&(Z=n.getMaxPrecision(x.precision),Z!==x.precision&&Yt("WebGLProgram.getParameters:",x.precision,"not supported, using",Z,"instead."));let j=L.morphAttributes.position||L.morphAttributes.normal||L.morphAttributes.color,nt=j!==void 0?j.length:0,ut=0;L.morphAttributes.position!==void 0&&(ut=1),L.morphAttributes.normal!==void 0&&(ut=2),L.morphAttributes.color!==void 0&&(ut=3);let ht,Q,dt,gt;if(at){let Ct=fs[at];ht=Ct.vertexShader,Q=Ct.fragmentShader}else{ht=x.vertexShader,Q=x.fragmentShader;let Ct=a.getVertexShaderStage(x),ce=a.getFragmentShaderStage(x);a.update(x,Ct,ce),dt=Ct.id,gt=ce.id}let Et=i.getRenderTarget(),St=i.state.buffers.depth.getReversed(),Ht=P.isInstancedMesh===!0,ne=P.isBatchedMesh===!0,Vt=!!x.map,le=!!x.matcap,he=!!H,se=he&&H.isPMREMTexture===!0,Qe=!!x.aoMap,We=!!x.lightMap,gn=!!x.bumpMap&&x.wireframe===!1,Ue=!!x.normalMap,Nn=!!x.displacementMap,ve=!!x.emissiveMap,wn=!!x.metalnessMap,rn=!!x.roughnessMap,_n=x.anisotropy>0,V=x.clearcoat>0,Rt=x.diffuseRoughness>0,Zt=x.dispersion>0,oe=x.retroreflectivity>0,bt=x.iridescence>0,ze=x.sheen>0,Gt=x.transmission>0,qt=_n&&!!x.anisotropyMap,N=V&&!!x.clearcoatMap,A=V&&!!x.clearcoatNormalMap,q=V&&!!x.clearcoatRoughnessMap,ct=Rt&&!!x.diffuseRoughnessMap,rt=bt&&!!x.iridescenceMap,xt=bt&&!!x.iridescenceThicknessMap,yt=ze&&!!x.sheenColorMap,tt=ze&&!!x.sheenRoughnessMap,it=!!x.specularMap,pt=!!x.specularColorMap,k=!!x.specularIntensityMap,st=Gt&&!!x.transmissionMap,et=Gt&&!!x.thicknessMap,wt=!!x.gradientMap,_t=!!x.alphaMap,Mt=x.alphaTest>0,Wt=!!x.alphaHash,Jt=!!x.extensions,lt=hs;x.toneMapped&&(Et===null||Et.isXRRenderTarget===!0)&&(lt=i.toneMapping);let Ot=se?H.isCompressedCubeTexture?H.image[0].mipmaps:H.mipmaps:null,jt={shaderID:at,shaderType:x.type,shaderName:x.name,vertexShader:ht,fragmentShader:Q,defines:x.defines,customVertexShaderID:dt,customFragmentShaderID:gt,isRawShaderMaterial:x.isRawShaderMaterial===!0,glslVersion:x.glslVersion,precision:Z,batching:ne,batchingColor:ne&&P._colorsTexture!==null,instancing:Ht,instancingColor:Ht&&P.instanceColor!==null,instancingMorph:Ht&&P.morphTexture!==null,outputColorSpace:Et===null?i.outputColorSpace:Et.isXRRenderTarget===!0?Et.texture.colorSpace:xe.workingColorSpace,alphaToCoverage:!!x.alphaToCoverage,map:Vt,matcap:le,envMap:he,envMapMode:he&&H.mapping,envMapPMREM:se,envMapMaxLod:se?Ot.length-1:null,envMapSize:se?Ot[0].width:null,aoMap:Qe,lightMap:We,bumpMap:gn,normalMap:Ue,displacementMap:Nn,emissiveMap:ve,normalMapObjectSpace:Ue&&x.normalMapType===Yg,normalMapTangentSpace:Ue&&x.normalMapType===Ph,packedNormalMap:Ue&&x.normalMapType===Ph&&h1(x.normalMap.format),metalnessMap:wn,roughnessMap:rn,anisotropy:_n,anisotropyMap:qt,clearcoat:V,clearcoatMap:N,clearcoatNormalMap:A,clearcoatRoughnessMap:q,diffuseRoughness:Rt,diffuseRoughnessMap:ct,dispersion:Zt,retroreflection:oe,iridescence:bt,iridescenceMap:rt,iridescenceThicknessMap:xt,sheen:ze,sheenColorMap:yt,sheenRoughnessMap:tt,specularMap:it,specularColorMap:pt,specularIntensityMap:k,transmission:Gt,transmissionMap:st,thicknessMap:et,gradientMap:wt,opaque:x.transparent===!1&&x.blending===Do&&x.alphaToCoverage===!1,alphaMap:_t,alphaTest:Mt,alphaHash:Wt,combine:x.combine,mapUv:Vt&&d(x.map.channel),aoMapUv:Qe&&d(x.aoMap.channel),lightMapUv:We&&d(x.lightMap.channel),bumpMapUv:gn&&d(x.bumpMap.channel),normalMapUv:Ue&&d(x.normalMap.channel),displacementMapUv:Nn&&d(x.displacementMap.channel),emissiveMapUv:ve&&d(x.emissiveMap.channel),metalnessMapUv:wn&&d(x.metalnessMap.channel),roughnessMapUv:rn&&d(x.roughnessMap.channel),anisotropyMapUv:qt&&d(x.anisotropyMap.channel),clearcoatMapUv:N&&d(x.clearcoatMap.channel),clearcoatNormalMapUv:A&&d(x.clearcoatNormalMap.channel),clearcoatRoughnessMapUv:q&&d(x.clearcoatRoughnessMap.channel),diffuseRoughnessMapUv:ct&&d(x.diffuseRoughnessMap.channel),iridescenceMapUv:rt&&d(x.iridescenceMap.channel),iridescenceThicknessMapUv:xt&&d(x.iridescenceThicknessMap.channel),sheenColorMapUv:yt&&d(x.sheenColorMap.channel),sheenRoughnessMapUv:tt&&d(x.sheenRoughnessMap.channel),specularMapUv:it&&d(x.specularMap.channel),specularColorMapUv:pt&&d(x.specularColorMap.channel),specularIntensityMapUv:k&&d(x.specularIntensityMap.channel),transmissionMapUv:st&&d(x.transmissionMap.channel),thicknessMapUv:et&&d(x.thicknessMap.channel),alphaMapUv:_t&&d(x.alphaMap.channel),vertexTangents:!!L.attributes.tangent&&(Ue||_n),vertexNormals:!!L.attributes.normal,vertexColors:x.vertexColors,vertexAlphas:x.vertexColors===!0&&!!L.attributes.color&&L.attributes.color.itemSize===4,pointsUvs:P.isPoints===!0&&!!L.attributes.uv&&(Vt||_t),fog:!!O,useFog:x.fog===!0,fogExp2:!!O&&O.isFogExp2,flatShading:x.wireframe===!1&&(x.flatShading===!0||L.attributes.normal===void 0&&Ue===!1&&(x.isMeshLambertMaterial||x.isMeshPhongMaterial||x.isMeshStandardMaterial||x.isMeshPhysicalMaterial)),sizeAttenuation:x.sizeAttenuation===!0,logarithmicDepthBuffer:u,reversedDepthBuffer:St,skinning:P.isSkinnedMesh===!0,hasPositionAttribute:L.attributes.position!==void 0,morphTargets:L.morphAttributes.position!==void 0,morphNormals:L.morphAttributes.normal!==void 0,morphColors:L.morphAttributes.color!==void 0,morphTargetsCount:nt,morphTextureStride:ut,numSunLights:b.sun.length,numDirLights:b.directional.length,numPointLights:b.point.length,numSpotLights:b.spot.length,numSpotLightMaps:b.spotLightMap.length,numRectAreaLights:b.rectArea.length,numHemiLights:b.hemi.length,numSunLightShadows:b.sunShadowMap.length,numDirLightShadows:b.directionalShadowMap.length,numPointLightShadows:b.pointShadowMap.length,numSpotLightShadows:b.spotShadowMap.length,numSpotLightShadowsWithMaps:b.numSpotLightShadowsWithMaps,numLightProbes:b.numLightProbes,numLightProbeGrids:I.filter(Ct=>Ct.texture!==null).length,numClippingPlanes:r.numPlanes,numClipIntersection:r.numIntersection,dithering:x.dithering,shadowMapEnabled:i.shadowMap.enabled&&D.length>0,shadowMapType:i.shadowMap.type,toneMapping:lt,decodeVideoTexture:Vt&&x.map.isVideoTexture===!0&&xe.getTransfer(x.map.colorSpace)===Re,decodeVideoTextureEmissive:ve&&x.emissiveMap.isVideoTexture===!0&&xe.getTransfer(x.emissiveMap.colorSpace)===Re,premultipliedAlpha:x.premultipliedAlpha,doubleSided:x.side===$n,flipSided:x.side===Cn,useDepthPacking:x.depthPacking>=0,depthPacking:x.depthPacking||0,index0AttributeName:x.index0AttributeName,extensionClipCullDistance:Jt&&x.extensions.clipCullDistance===!0&&e.has("WEBGL_clip_cull_distance"),extensionMultiDraw:(Jt&&x.extensions.multiDraw===!0||ne)&&e.has("WEBGL_multi_draw"),rendererExtensionParallelShaderCompile:e.has("KHR_parallel_shader_compile"),customProgramCacheKey:x.customProgramCacheKey()};return jt.vertexUv1s=l.has(1),jt.vertexUv2s=l.has(2),jt.vertexUv3s=l.has(3),l.clear(),jt}function v(x){let b=[];if(x.shaderID?b.push(x.shaderID):(b.push(x.customVertexShaderID),b.push(x.customFragmentShaderID)),x.defines!==void 0)for(let D in x.defines)b.push(D),b.push(x.defines[D]);return x.isRawShaderMaterial===!1&&(m(b,x),p(b,x),b.push(i.outputColorSpace)),b.push(x.customProgramCacheKey),b.join()}function m(x,b){x.push(b.precision),x.push(b.outputColorSpace),x.push(b.envMapMode),x.push(b.envMapPMREM),x.push(b.envMapMaxLod),x.push(b.envMapSize),x.push(b.mapUv),x.push(b.alphaMapUv),x.push(b.lightMapUv),x.push(b.aoMapUv),x.push(b.bumpMapUv),x.push(b.normalMapUv),x.push(b.displacementMapUv),x.push(b.emissiveMapUv),x.push(b.metalnessMapUv),x.push(b.roughnessMapUv),x.push(b.anisotropyMapUv),x.push(b.clearcoatMapUv),x.push(b.clearcoatNormalMapUv),x.push(b.clearcoatRoughnessMapUv),x.push(b.diffuseRoughnessMapUv),x.push(b.iridescenceMapUv),x.push(b.iridescenceThicknessMapUv),x.push(b.sheenColorMapUv),x.push(b.sheenRoughnessMapUv),x.push(b.specularMapUv),x.push(b.specularColorMapUv),x.push(b.specularIntensityMapUv),x.push(b.transmissionMapUv),x.push(b.thicknessMapUv),x.push(b.combine),x.push(b.fogExp2),x.push(b.sizeAttenuation),x.push(b.morphTargetsCount),x.push(b.numSunLights),x.push(b.numDirLights),x.push(b.numPointLights),x.push(b.numSpotLights),x.push(b.numSpotLightMaps),x.push(b.numHemiLights),x.push(b.numRectAreaLights),x.push(b.numSunLightShadows),x.push(b.numDirLightShadows),x.push(b.numPointLightShadows),x.push(b.numSpotLightShadows),x.push(b.numSpotLightShadowsWithMaps),x.push(b.numLightProbes),x.push(b.numLightProbeGrids),x.push(b.shadowMapType),x.push(b.toneMapping),x.push(b.numClippingPlanes),x.push(b.numClipIntersection),x.push(b.depthPacking)}function p(x,b){o.disableAll(),b.instancing&&o.enable(0),b.instancingColor&&o.enable(1),b.instancingMorph&&o.enable(2),b.matcap&&o.enable(3),b.envMap&&o.enable(4),b.normalMapObjectSpace&&o.enable(5),b.normalMapTangentSpace&&o.enable(6),b.clearcoat&&o.enable(7),b.iridescence&&o.enable(8),b.alphaTest&&o.enable(9),b.vertexColors&&o.enable(10),b.vertexAlphas&&o.enable(11),b.vertexUv1s&&o.enable(12),b.vertexUv2s&&o.enable(13),b.vertexUv3s&&o.enable(14),b.vertexTangents&&o.enable(15),b.anisotropy&&o.enable(16),b.alphaHash&&o.enable(17),b.batching&&o.enable(18),b.dispersion&&o.enable(19),b.retroreflection&&o.enable(24),b.diffuseRoughness&&o.enable(25),b.batchingColor&&o.enable(20),b.gradientMap&&o.enable(21),b.packedNormalMap&&o.enable(22),b.vertexNormals&&o.enable(23),x.push(o.mask),o.disableAll(),b.fog&&o.enable(0),b.useFog&&o.enable(1),b.flatShading&&o.enable(2),b.logarithmicDepthBuffer&&o.enable(3),b.reversedDepthBuffer&&o.enable(4),b.skinning&&o.enable(5),b.morphTargets&&o.enable(6),b.morphNormals&&o.enable(7),b.morphColors&&o.enable(8),b.premultipliedAlpha&&o.enable(9),b.shadowMapEnabled&&o.enable(10),b.doubleSided&&o.enable(11),b.flipSided&&o.enable(12),b.useDepthPacking&&o.enable(13),b.dithering&&o.enable(14),b.transmission&&o.enable(15),b.sheen&&o.enable(16),b.opaque&&o.enable(17),b.pointsUvs&&o.enable(18),b.decodeVideoTexture&&o.enable(19),b.decodeVideoTextureEmissive&&o.enable(20),b.alphaToCoverage&&o.enable(21),b.numLightProbeGrids>0&&o.enable(22),b.hasPositionAttribute&&o.enable(23),x.push(o.mask)}function _(x){let b=h[x.type],D;if(b){let C=fs[b];D=a0.clone(C.uniforms)}else D=x.uniforms;return D}function M(x,b){let D=f.get(b);return D!==void 0?++D.usedTimes:(D=new l1(i,b,x,s),c.push(D),f.set(b,D)),D}function y(x){if(--x.usedTimes===0){let b=c.indexOf(x);c[b]=c[c.length-1],c.pop(),f.delete(x.cacheKey),x.destroy()}}function w(x){a.remove(x)}function T(){a.dispose()}return{getParameters:g,getProgramCacheKey:v,getUniforms:_,acquireProgram:M,releaseProgram:y,releaseShaderCache:w,programs:c,dispose:T}}function f1(){let i=new WeakMap;function t(o){return i.has(o)}function e(o){let a=i.get(o);return a===void 0&&(a={},i.set(o,a)),a}function n(o){i.delete(o)}function s(o,a,l){i.get(o)[a]=l}function r(){i=new WeakMap}return{has:t,get:e,remove:n,update:s,dispose:r}}function d1(i,t){return i.groupOrder!==t.groupOrder?i.groupOrder-t.groupOrder:i.renderOrder!==t.renderOrder?i.renderOrder-t.renderOrder:i.material.id!==t.material.id?i.material.id-t.material.id:i.materialVariant!==t.materialVariant?i.materialVariant-t.materialVariant:i.z!==t.z?i.z-t.z:i.id-t.id}function E0(i,t){return i.groupOrder!==t.groupOrder?i.groupOrder-t.groupOrder:i.renderOrder!==t.renderOrder?i.renderOrder-t.renderOrder:i.z!==t.z?t.z-i.z:i.id-t.id}function C0(){let i=[],t=0,e=[],n=[],s=[];function r(){t=0,e.length=0,n.length=0,s.length=0}function o(h){let d=0;return h.isInstancedMesh&&(d+=2),h.isSkinnedMesh&&(d+=1),d}function a(h,d,g,v,m,p){let _=i[t];return _===void 0?(_={id:h.id,object:h,geometry:d,material:g,materialVariant:o(h),groupOrder:v,renderOrder:h.renderOrder,z:m,group:p},i[t]=_):(_.id=h.id,_.object=h,_.geometry=d,_.material=g,_.materialVariant=o(h),_.groupOrder=v,_.renderOrder=h.renderOrder,_.z=m,_.group=p),t++,_}function l(h,d,g,v,m,p,_){_.reversedDepth===!0&&(m=-m);let M=a(h,d,g,v,m,p);g.transmission>0?n.push(M):g.transparent===!0?s.push(M):e.push(M)}function c(h,d,g,v,m,p){let _=a(h,d,g,v,m,p);g.transmission>0?n.unshift(_):g.transparent===!0?s.unshift(_):e.unshift(_)}function f(h,d){e.length>1&&e.sort(h||d1),n.length>1&&n.sort(d||E0),s.length>1&&s.sort(d||E0)}function u(){for(let h=t,d=i.length;h<d;h++){let g=i[h];if(g.id===null)break;g.id=null,g.object=null,g.geometry=null,g.material=null,g.group=null}}return{opaque:e,transmissive:n,transparent:s,init:r,push:l,unshift:c,finish:u,sort:f}}function p1(){let i=new WeakMap;function t(n,s){let r=i.get(n),o;return r===void 0?(o=new C0,i.set(n,[o])):s>=r.length?(o=new C0,r.push(o)):o=r[s],o}function e(){i=new WeakMap}return{get:t,dispose:e}}function m1(){let i={};return{get:function(t){if(i[t.id]!==void 0)return i[t.id];let e;switch(t.type){case"SunLight":case"DirectionalLight":e={direction:new U,color:new $t};break;case"SpotLight":e={position:new U,direction:new U,color:new $t,distance:0,coneCos:0,penumbraCos:0,decay:0};break;case"PointLight":e={position:new U,color:new $t,distance:0,decay:0};break;case"HemisphereLight":e={direction:new U,skyColor:new $t,groundColor:new $t};break;case"RectAreaLight":e={color:new $t,position:new U,halfWidth:new U,halfHeight:new U};break}return i[t.id]=e,e}}}function g1(){let i={};return{get:function(t){if(i[t.id]!==void 0)return i[t.id];let e;switch(t.type){case"SunLight":case"DirectionalLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new kt};break;case"SpotLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new kt};break;case"PointLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new kt,shadowCameraNear:1,shadowCameraFar:1e3};break}return i[t.id]=e,e}}}var _1=0;function x1(i,t){return(t.castShadow?2:0)-(i.castShadow?2:0)+(t.map?1:0)-(i.map?1:0)}function y1(i){let t=new m1,e=g1(),n={version:0,hash:{sunLength:-1,directionalLength:-1,pointLength:-1,spotLength:-1,rectAreaLength:-1,hemiLength:-1,numSunShadows:-1,numDirectionalShadows:-1,numPointShadows:-1,numSpotShadows:-1,numSpotMaps:-1,numLightProbes:-1},ambient:[0,0,0],probe:[],sun:[],sunShadow:[],sunShadowMap:[],sunShadowMatrix:[],sunShadowCascade:[],directional:[],directionalShadow:[],directionalShadowMap:[],directionalShadowMatrix:[],spot:[],spotLightMap:[],spotShadow:[],spotShadowMap:[],spotLightMatrix:[],rectArea:[],rectAreaLTC1:null,rectAreaLTC2:null,point:[],pointShadow:[],pointShadowMap:[],pointShadowMatrix:[],hemi:[],numSpotLightShadowsWithMaps:0,numLightProbes:0};for(let c=0;c<9;c++)n.probe.push(new U);let s=new U,r=new te,o=new te;function a(c){let f=0,u=0,h=0;for(let I=0;I<9;I++)n.probe[I].set(0,0,0);let d=0,g=0,v=0,m=0,p=0,_=0,M=0,y=0,w=0,T=0,x=0,b=0,D=0,C=0;c.sort(x1);for(let I=0,O=c.length;I<O;I++){let L=c[I],z=L.color,X=L.intensity,H=L.distance,at=null;if(L.shadow&&L.shadow.map&&(L.shadow.map.texture.format===rr?at=L.shadow.map.texture:at=L.shadow.map.depthTexture||L.shadow.map.texture),L.isAmbientLight)f+=z.r*X,u+=z.g*X,h+=z.b*X;else if(L.isLightProbe){for(let Z=0;Z<9;Z++)n.probe[Z].addScaledVector(L.sh.coefficients[Z],X);C++}else if(L.isSunLight){let Z=t.get(L);if(Z.color.copy(L.color).multiplyScalar(L.intensity),L.castShadow){let j=L.shadow,nt=e.get(L);nt.shadowIntensity=j.intensity,nt.shadowBias=j.bias,nt.shadowNormalBias=j.normalBias,nt.shadowRadius=j.radius,nt.shadowMapSize.copy(j.mapSize).multiply(j.getFrameExtents()),n.sunShadow[g]=nt,n.sunShadowMap[g]=at;let ut=j.getViewportCount();for(let ht=0;ht<ut;ht++)n.sunShadowMatrix[v+ht]=j.getMatrix(ht),n.sunShadowCascade[v+ht]=j._cascadeData[ht];v+=ut,g++}n.sun[d]=Z,d++}else if(L.isDirectionalLight){let Z=t.get(L);if(Z.color.copy(L.color).multiplyScalar(L.intensity),L.castShadow){let j=L.shadow,nt=e.get(L);nt.shadowIntensity=j.intensity,nt.shadowBias=j.bias,nt.shadowNormalBias=j.normalBias,nt.shadowRadius=j.radius,nt.shadowMapSize=j.mapSize,n.directionalShadow[m]=nt,n.directionalShadowMap[m]=at,n.directionalShadowMatrix[m]=L.shadow.matrix,w++}n.directional[m]=Z,m++}else if(L.isSpotLight){let Z=t.get(L);Z.position.setFromMatrixPosition(L.matrixWorld),Z.color.copy(z).multiplyScalar(X),Z.distance=H,Z.coneCos=Math.cos(L.angle),Z.penumbraCos=Math.cos(L.angle*(1-L.penumbra)),Z.decay=L.decay,n.spot[_]=Z;let j=L.shadow;if(L.map&&(n.spotLightMap[b]=L.map,b++,j.updateMatrices(L),L.castShadow&&D++),n.spotLightMatrix[_]=j.matrix,L.castShadow){let nt=e.get(L);nt.shadowIntensity=j.intensity,nt.shadowBias=j.bias,nt.shadowNormalBias=j.normalBias,nt.shadowRadius=j.radius,nt.shadowMapSize=j.mapSize,n.spotShadow[_]=nt,n.spotShadowMap[_]=at,x++}_++}else if(L.isRectAreaLight){let Z=t.get(L);Z.color.copy(z).multiplyScalar(X),Z.halfWidth.set(L.width*.5,0,0),Z.halfHeight.set(0,L.height*.5,0),n.rectArea[M]=Z,M++}else if(L.isPointLight){let Z=t.get(L);if(Z.color.copy(L.color).multiplyScalar(L.intensity),Z.distance=L.distance,Z.decay=L.decay,L.castShadow){let j=L.shadow,nt=e.get(L);nt.shadowIntensity=j.intensity,nt.shadowBias=j.bias,nt.shadowNormalBias=j.normalBias,nt.shadowRadius=j.radius,nt.shadowMapSize=j.mapSize,nt.shadowCameraNear=j.camera.near,nt.shadowCameraFar=j.camera.far,n.pointShadow[p]=nt,n.pointShadowMap[p]=at,n.pointShadowMatrix[p]=L.shadow.matrix,T++}n.point[p]=Z,p++}else if(L.isHemisphereLight){let Z=t.get(L);Z.skyColor.copy(L.color).multiplyScalar(X),Z.groundColor.copy(L.groundColor).multiplyScalar(X),n.hemi[y]=Z,y++}}M>0&&(i.has("OES_texture_float_linear")===!0?(n.rectAreaLTC1=Lt.LTC_FLOAT_1,n.rectAreaLTC2=Lt.LTC_FLOAT_2):(n.rectAreaLTC1=Lt.LTC_HALF_1,n.rectAreaLTC2=Lt.LTC_HALF_2)),n.ambient[0]=f,n.ambient[1]=u,n.ambient[2]=h;let P=n.hash;(P.sunLength!==d||P.directionalLength!==m||P.pointLength!==p||P.spotLength!==_||P.rectAreaLength!==M||P.hemiLength!==y||P.numSunShadows!==g||P.numDirectionalShadows!==w||P.numPointShadows!==T||P.numSpotShadows!==x||P.numSpotMaps!==b||P.numLightProbes!==C)&&(n.sun.length=d,n.directional.length=m,n.spot.length=_,n.rectArea.length=M,n.point.length=p,n.hemi.length=y,n.sunShadow.length=g,n.sunShadowMap.length=g,n.sunShadowMatrix.length=v,n.sunShadowCascade.length=v,n.directionalShadow.length=w,n.directionalShadowMap.length=w,n.directionalShadowMatrix.length=w,n.pointShadow.length=T,n.pointShadowMap.length=T,n.pointShadowMatrix.length=T,n.spotShadow.length=x,n.spotShadowMap.length=x,n.spotLightMatrix.length=x+b-D,n.spotLightMap.length=b,n.numSpotLightShadowsWithMaps=D,n.numLightProbes=C,P.sunLength=d,P.directionalLength=m,P.pointLength=p,P.spotLength=_,P.rectAreaLength=M,P.hemiLength=y,P.numSunShadows=g,P.numDirectionalShadows=w,P.numPointShadows=T,P.numSpotShadows=x,P.numSpotMaps=b,P.numLightProbes=C,n.version=_1++)}function l(c,f){let u=0,h=0,d=0,g=0,v=0,m=0,p=f.matrixWorldInverse;for(let _=0,M=c.length;_<M;_++){let y=c[_];if(y.isSunLight){let w=n.sun[u];w.direction.setFromMatrixPosition(y.matrixWorld),w.direction.transformDirection(p),u++}else if(y.isDirectionalLight){let w=n.directional[h];w.direction.setFromMatrixPosition(y.matrixWorld),s.setFromMatrixPosition(y.target.matrixWorld),w.direction.sub(s),w.direction.transformDirection(p),h++}else if(y.isSpotLight){let w=n.spot[g];w.position.setFromMatrixPosition(y.matrixWorld),w.position.applyMatrix4(p),w.direction.setFromMatrixPosition(y.matrixWorld),s.setFromMatrixPosition(y.target.matrixWorld),w.direction.sub(s),w.direction.transformDirection(p),g++}else if(y.isRectAreaLight){let w=n.rectArea[v];w.position.setFromMatrixPosition(y.matrixWorld),w.position.applyMatrix4(p),o.identity(),r.copy(y.matrixWorld),r.premultiply(p),o.extractRotation(r),w.halfWidth.set(y.width*.5,0,0),w.halfHeight.set(0,y.height*.5,0),w.halfWidth.applyMatrix4(o),w.halfHeight.applyMatrix4(o),v++}else if(y.isPointLight){let w=n.point[d];w.position.setFromMatrixPosition(y.matrixWorld),w.position.applyMatrix4(p),d++}else if(y.isHemisphereLight){let w=n.hemi[m];w.direction.setFromMatrixPosition(y.matrixWorld),w.direction.transformDirection(p),m++}}}return{setup:a,setupView:l,state:n}}function R0(i){let t=new y1(i),e=[],n=[],s=[];function r(u){f.camera=u,e.length=0,n.length=0,s.length=0}function o(u){u.isLightProbeGrid?s.push(u):e.push(u)}function a(u){n.push(u)}function l(){t.setup(e),s.sort((u,h)=>u.priority-h.priority||u.id-h.id)}function c(u){t.setupView(e,u)}let f={lightsArray:e,shadowsArray:n,lightProbeGridArray:s,camera:null,lights:t,transmissionRenderTarget:{},textureUnits:0};return{init:r,state:f,setupLights:l,setupLightsView:c,pushLight:o,pushShadow:a}}function v1(i){let t=new WeakMap;function e(s,r=0){let o=t.get(s),a;return o===void 0?(a=new R0(i),t.set(s,[a])):r>=o.length?(a=new R0(i),o.push(a)):a=o[r],a}function n(){t=new WeakMap}return{get:e,dispose:n}}var S1=`void main() {
	gl_Position = vec4( position, 1.0 );
}`,M1=`uniform sampler2D shadow_pass;
uniform vec2 resolution;
uniform float radius;
void main() {
	const float samples = float( VSM_SAMPLES );
	float mean = 0.0;
	float squared_mean = 0.0;
	float uvStride = samples <= 1.0 ? 0.0 : 2.0 / ( samples - 1.0 );
	float uvStart = samples <= 1.0 ? 0.0 : - 1.0;
	for ( float i = 0.0; i < samples; i ++ ) {
		float uvOffset = uvStart + i * uvStride;
		#ifdef HORIZONTAL_PASS
			vec2 distribution = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( uvOffset, 0.0 ) * radius ) / resolution ).rg;
			mean += distribution.x;
			squared_mean += distribution.y * distribution.y + distribution.x * distribution.x;
		#else
			float depth = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( 0.0, uvOffset ) * radius ) / resolution ).r;
			mean += depth;
			squared_mean += depth * depth;
		#endif
	}
	mean = mean / samples;
	squared_mean = squared_mean / samples;
	float std_dev = sqrt( max( 0.0, squared_mean - mean * mean ) );
	gl_FragColor = vec4( mean, std_dev, 0.0, 1.0 );
}`,b1=[new U(1,0,0),new U(-1,0,0),new U(0,1,0),new U(0,-1,0),new U(0,0,1),new U(0,0,-1)],w1=[new U(0,-1,0),new U(0,-1,0),new U(0,0,1),new U(0,0,-1),new U(0,-1,0),new U(0,-1,0)],P0=new te,ul=new U,Yd=new U;function T1(i,t,e){let n=new js,s=new kt,r=new kt,o=new nn,a=new Pc,l=new Ic,c={},f=e.maxTextureSize,u={[Mi]:Cn,[Cn]:Mi,[$n]:$n},h=new ls({defines:{VSM_SAMPLES:8},uniforms:{shadow_pass:{value:null},resolution:{value:new kt},radius:{value:4}},vertexShader:S1,fragmentShader:M1}),d=h.clone();d.defines.HORIZONTAL_PASS=1;let g=new pn;g.setAttribute("position",new Je(new Float32Array([-1,-1,.5,3,-1,.5,-1,3,.5]),3));let v=new En(g,h),m=this;this.enabled=!1,this.autoUpdate=!0,this.needsUpdate=!1,this.type=il;let p=this.type;this.render=function(T,x,b){if(m.enabled===!1||m.autoUpdate===!1&&m.needsUpdate===!1||T.length===0)return;this.type===wg&&(Yt("WebGLShadowMap: PCFSoftShadowMap has been removed. Using PCFShadowMap instead."),this.type=il);let D=i.getRenderTarget(),C=i.getActiveCubeFace(),P=i.getActiveMipmapLevel(),I=i.state;I.setBlending(Er),I.buffers.depth.getReversed()===!0?I.buffers.color.setClear(0,0,0,0):I.buffers.color.setClear(1,1,1,1),I.buffers.depth.setTest(!0),I.setScissorTest(!1);let O=p!==this.type;O&&x.traverse(function(L){L.material&&(Array.isArray(L.material)?L.material.forEach(z=>z.needsUpdate=!0):L.material.needsUpdate=!0)});for(let L=0,z=T.length;L<z;L++){let X=T[L],H=X.shadow;if(H===void 0){Yt("WebGLShadowMap:",X,"has no shadow.");continue}if(H.autoUpdate===!1&&H.needsUpdate===!1)continue;s.copy(H.mapSize);let at=H.getFrameExtents();s.multiply(at),r.copy(H.mapSize),(s.x>f||s.y>f)&&(s.x>f&&(r.x=Math.floor(f/at.x),s.x=r.x*at.x,H.mapSize.x=r.x),s.y>f&&(r.y=Math.floor(f/at.y),s.y=r.y*at.y,H.mapSize.y=r.y));let Z=i.state.buffers.depth.getReversed();if(H.camera._reversedDepth=Z,H.map===null||O===!0){if(H.map!==null&&(H.map.depthTexture!==null&&(H.map.depthTexture.dispose(),H.map.depthTexture=null),H.map.dispose()),this.type===Lo){if(X.isPointLight){Yt("WebGLShadowMap: VSM shadow maps are not supported for PointLights. Use PCF or BasicShadowMap instead.");continue}H.map=new vi(s.x,s.y,{format:rr,type:Wi,minFilter:si,magFilter:si,generateMipmaps:!1}),H.map.texture.name=X.name+".shadowMap",H.map.depthTexture=new Ds(s.x,s.y,ui),H.map.depthTexture.name=X.name+".shadowMapDepth",H.map.depthTexture.format=Rs,H.map.depthTexture.compareFunction=null,H.map.depthTexture.minFilter=Vn,H.map.depthTexture.magFilter=Vn}else X.isPointLight?(H.map=new dl(s.x),H.map.depthTexture=new Wa(s.x,Hi)):(H.map=new vi(s.x,s.y),H.map.depthTexture=new Ds(s.x,s.y,Hi)),H.map.depthTexture.name=X.name+".shadowMap",H.map.depthTexture.format=Rs,this.type===il?(H.map.depthTexture.compareFunction=Z?Rd:Cd,H.map.depthTexture.minFilter=si,H.map.depthTexture.magFilter=si):(H.map.depthTexture.compareFunction=null,H.map.depthTexture.minFilter=Vn,H.map.depthTexture.magFilter=Vn);H.camera.updateProjectionMatrix()}H.map.isWebGLCubeRenderTarget!==!0&&(H.map.width!==s.x||H.map.height!==s.y)&&H.map.setSize(s.x,s.y);let j=H.map.isWebGLCubeRenderTarget?6:H.getViewportCount();X.isPointLight!==!0&&H.updateMatrices(X,b);let nt=(H.camera.layers.mask&4294967294)!==0?H.camera.layers:b.layers;for(let ut=0;ut<j;ut++){let ht=H.getCamera(ut);if(X.isPointLight){let Q=H.camera,dt=H.matrix,gt=X.distance||Q.far;gt!==Q.far&&(Q.far=gt,Q.updateProjectionMatrix()),ul.setFromMatrixPosition(X.matrixWorld),Q.position.copy(ul),Yd.copy(Q.position),Yd.add(b1[ut]),Q.up.copy(w1[ut]),Q.lookAt(Yd),Q.updateMatrixWorld(),dt.makeTranslation(-ul.x,-ul.y,-ul.z),P0.multiplyMatrices(Q.projectionMatrix,Q.matrixWorldInverse),H._frustum.setFromProjectionMatrix(P0,Q.coordinateSystem,Q.reversedDepth)}if(H.map.isWebGLCubeRenderTarget)i.setRenderTarget(H.map,ut),i.clear();else{ut===0&&(i.setRenderTarget(H.map),i.clear());let Q=H.getViewport(ut);o.set(r.x*Q.x,r.y*Q.y,r.x*Q.z,r.y*Q.w),I.viewport(o)}n=H.getFrustum(ut),y(x,b,ht,X,nt,this.type)}H.isPointLightShadow!==!0&&this.type===Lo&&_(H,b),H.needsUpdate=!1}p=this.type,m.needsUpdate=!1,i.setRenderTarget(D,C,P)};function _(T,x){let b=t.update(v);h.defines.VSM_SAMPLES!==T.blurSamples&&(h.defines.VSM_SAMPLES=T.blurSamples,d.defines.VSM_SAMPLES=T.blurSamples,h.needsUpdate=!0,d.needsUpdate=!0),T.mapPass===null?T.mapPass=new vi(s.x,s.y,{format:rr,type:Wi}):(T.mapPass.width!==T.map.width||T.mapPass.height!==T.map.height)&&T.mapPass.setSize(T.map.width,T.map.height),h.uniforms.shadow_pass.value=T.map.depthTexture,h.uniforms.resolution.value.set(T.map.width,T.map.height),h.uniforms.radius.value=T.radius,i.setRenderTarget(T.mapPass),i.clear(),i.renderBufferDirect(x,null,b,h,v,null),d.uniforms.shadow_pass.value=T.mapPass.texture,d.uniforms.resolution.value.set(T.map.width,T.map.height),d.uniforms.radius.value=T.radius,i.setRenderTarget(T.map),i.clear(),i.renderBufferDirect(x,null,b,d,v,null)}function M(T,x,b,D){let C=null,P=b.isPointLight===!0?T.customDistanceMaterial:T.customDepthMaterial;if(P!==void 0)C=P;else if(C=b.isPointLight===!0?l:a,i.localClippingEnabled&&x.clipShadows===!0&&Array.isArray(x.clippingPlanes)&&x.clippingPlanes.length!==0||x.displacementMap&&x.displacementScale!==0||x.alphaMap&&x.alphaTest>0||x.map&&x.alphaTest>0||x.alphaToCoverage===!0){let I=C.uuid,O=x.uuid,L=c[I];L===void 0&&(L={},c[I]=L);let z=L[O];z===void 0&&(z=C.clone(),L[O]=z,x.addEventListener("dispose",w)),C=z}if(C.visible=x.visible,C.wireframe=x.wireframe,D===Lo?C.side=x.shadowSide!==null?x.shadowSide:x.side:C.side=x.shadowSide!==null?x.shadowSide:u[x.side],C.alphaMap=x.alphaMap,C.alphaTest=x.alphaToCoverage===!0?.5:x.alphaTest,C.map=x.map,C.clipShadows=x.clipShadows,C.clippingPlanes=x.clippingPlanes,C.clipIntersection=x.clipIntersection,C.displacementMap=x.displacementMap,C.displacementScale=x.displacementScale,C.displacementBias=x.displacementBias,C.wireframeLinewidth=x.wireframeLinewidth,C.linewidth=x.linewidth,b.isPointLight===!0&&C.isMeshDistanceMaterial===!0){let I=i.properties.get(C);I.light=b}return C}function y(T,x,b,D,C,P){if(T.visible===!1)return;if(T.layers.test(C)&&(T.isMesh||T.isLine||T.isPoints)&&(T.castShadow||T.receiveShadow&&P===Lo)&&(!T.frustumCulled||T.intersectsFrustum(n))){T.modelViewMatrix.multiplyMatrices(b.matrixWorldInverse,T.matrixWorld);let L=t.update(T),z=T.material;if(Array.isArray(z)){let X=L.groups;for(let H=0,at=X.length;H<at;H++){let Z=X[H],j=z[Z.materialIndex];if(j&&j.visible){let nt=M(T,j,D,P);T.onBeforeShadow(i,T,x,b,L,nt,Z),i.renderBufferDirect(b,null,L,nt,T,Z),T.onAfterShadow(i,T,x,b,L,nt,Z)}}}else if(z.visible){let X=M(T,z,D,P);T.onBeforeShadow(i,T,x,b,L,X,null),i.renderBufferDirect(b,null,L,X,T,null),T.onAfterShadow(i,T,x,b,L,X,null)}}let O=T.children;for(let L=0,z=O.length;L<z;L++)y(O[L],x,b,D,C,P)}function w(T){T.target.removeEventListener("dispose",w);for(let b in c){let D=c[b],C=T.target.uuid;C in D&&(D[C].dispose(),delete D[C])}}}function A1(i,t){function e(){let k=!1,st=new nn,et=null,wt=new nn(0,0,0,0);return{setMask:function(_t){et!==_t&&!k&&(i.colorMask(_t,_t,_t,_t),et=_t)},setLocked:function(_t){k=_t},setClear:function(_t,Mt,Wt,Jt,lt){lt===!0&&(_t*=Jt,Mt*=Jt,Wt*=Jt),st.set(_t,Mt,Wt,Jt),wt.equals(st)===!1&&(i.clearColor(_t,Mt,Wt,Jt),wt.copy(st))},reset:function(){k=!1,et=null,wt.set(-1,0,0,0)}}}function n(){let k=!1,st=!1,et=null,wt=null,_t=null;return{setReversed:function(Mt){if(st!==Mt){let Wt=t.get("EXT_clip_control");Mt?Wt.clipControlEXT(Wt.LOWER_LEFT_EXT,Wt.ZERO_TO_ONE_EXT):Wt.clipControlEXT(Wt.LOWER_LEFT_EXT,Wt.NEGATIVE_ONE_TO_ONE_EXT),st=Mt;let Jt=_t;_t=null,this.setClear(Jt)}},getReversed:function(){return st},setTest:function(Mt){Mt?St(i.DEPTH_TEST):Ht(i.DEPTH_TEST)},setMask:function(Mt){et!==Mt&&!k&&(i.depthMask(Mt),et=Mt)},setFunc:function(Mt){if(st&&(Mt=i0[Mt]),wt!==Mt){switch(Mt){case pc:i.depthFunc(i.NEVER);break;case mc:i.depthFunc(i.ALWAYS);break;case gc:i.depthFunc(i.LESS);break;case Js:i.depthFunc(i.LEQUAL);break;case _c:i.depthFunc(i.EQUAL);break;case xc:i.depthFunc(i.GEQUAL);break;case vo:i.depthFunc(i.GREATER);break;case yc:i.depthFunc(i.NOTEQUAL);break;default:i.depthFunc(i.LEQUAL)}wt=Mt}},setLocked:function(Mt){k=Mt},setClear:function(Mt){_t!==Mt&&(_t=Mt,st&&(Mt=1-Mt),i.clearDepth(Mt))},reset:function(){k=!1,et=null,wt=null,_t=null,st=!1}}}function s(){let k=!1,st=null,et=null,wt=null,_t=null,Mt=null,Wt=null,Jt=null,lt=null;return{setTest:function(Ot){k||(Ot?St(i.STENCIL_TEST):Ht(i.STENCIL_TEST))},setMask:function(Ot){st!==Ot&&!k&&(i.stencilMask(Ot),st=Ot)},setFunc:function(Ot,jt,Ct){(et!==Ot||wt!==jt||_t!==Ct)&&(i.stencilFunc(Ot,jt,Ct),et=Ot,wt=jt,_t=Ct)},setOp:function(Ot,jt,Ct){(Mt!==Ot||Wt!==jt||Jt!==Ct)&&(i.stencilOp(Ot,jt,Ct),Mt=Ot,Wt=jt,Jt=Ct)},setLocked:function(Ot){k=Ot},setClear:function(Ot){lt!==Ot&&(i.clearStencil(Ot),lt=Ot)},reset:function(){k=!1,st=null,et=null,wt=null,_t=null,Mt=null,Wt=null,Jt=null,lt=null}}}let r=new e,o=new n,a=new s,l={},c=new WeakMap,f={},u={},h={},d=new WeakMap,g=[],v=null,m=!1,p=null,_=null,M=null,y=null,w=null,T=null,x=null,b=new $t(0,0,0),D=0,C=!1,P=null,I=null,O=null,L=null,z=null,X=i.getParameter(i.MAX_COMBINED_TEXTURE_IMAGE_UNITS),H=!1,at=0,Z=i.getParameter(i.VERSION);Z.indexOf("WebGL")!==-1?(at=parseFloat(/^WebGL (\d)/.exec(Z)[1]),H=at>=1):Z.indexOf("OpenGL ES")!==-1&&(at=parseFloat(/^OpenGL ES (\d)/.exec(Z)[1]),H=at>=2);let j=null,nt={},ut=i.getParameter(i.SCISSOR_BOX),ht=i.getParameter(i.VIEWPORT),Q=new nn().fromArray(ut),dt=new nn().fromArray(ht);function gt(k,st,et,wt){let _t=new Uint8Array(4),Mt=i.createTexture();i.bindTexture(k,Mt),i.texParameteri(k,i.TEXTURE_MIN_FILTER,i.NEAREST),i.texParameteri(k,i.TEXTURE_MAG_FILTER,i.NEAREST);for(let Wt=0;Wt<et;Wt++)k===i.TEXTURE_3D||k===i.TEXTURE_2D_ARRAY?i.texImage3D(st,0,i.RGBA,1,1,wt,0,i.RGBA,i.UNSIGNED_BYTE,_t):i.texImage2D(st+Wt,0,i.RGBA,1,1,0,i.RGBA,i.UNSIGNED_BYTE,_t);return Mt}let Et={};Et[i.TEXTURE_2D]=gt(i.TEXTURE_2D,i.TEXTURE_2D,1),Et[i.TEXTURE_CUBE_MAP]=gt(i.TEXTURE_CUBE_MAP,i.TEXTURE_CUBE_MAP_POSITIVE_X,6),Et[i.TEXTURE_2D_ARRAY]=gt(i.TEXTURE_2D_ARRAY,i.TEXTURE_2D_ARRAY,1,1),Et[i.TEXTURE_3D]=gt(i.TEXTURE_3D,i.TEXTURE_3D,1,1),r.setClear(0,0,0,1),o.setClear(1),a.setClear(0),St(i.DEPTH_TEST),o.setFunc(Js),gn(!1),Ue(sd),St(i.CULL_FACE),Qe(Er);function St(k){f[k]!==!0&&(i.enable(k),f[k]=!0)}function Ht(k){f[k]!==!1&&(i.disable(k),f[k]=!1)}function ne(k,st){return h[k]!==st?(i.bindFramebuffer(k,st),h[k]=st,k===i.DRAW_FRAMEBUFFER&&(h[i.FRAMEBUFFER]=st),k===i.FRAMEBUFFER&&(h[i.DRAW_FRAMEBUFFER]=st),!0):!1}function Vt(k,st){let et=g,wt=!1;if(k){et=d.get(st),et===void 0&&(et=[],d.set(st,et));let _t=k.textures;if(et.length!==_t.length||et[0]!==i.COLOR_ATTACHMENT0){for(let Mt=0,Wt=_t.length;Mt<Wt;Mt++)et[Mt]=i.COLOR_ATTACHMENT0+Mt;et.length=_t.length,wt=!0}}else et[0]!==i.BACK&&(et[0]=i.BACK,wt=!0);wt&&i.drawBuffers(et)}function le(k){return v!==k?(i.useProgram(k),v=k,!0):!1}let he={[Cr]:i.FUNC_ADD,[Ag]:i.FUNC_SUBTRACT,[Eg]:i.FUNC_REVERSE_SUBTRACT};he[Cg]=i.MIN,he[Rg]=i.MAX;let se={[Pg]:i.ZERO,[Ig]:i.ONE,[Lg]:i.SRC_COLOR,[ld]:i.SRC_ALPHA,[Bg]:i.SRC_ALPHA_SATURATE,[Fg]:i.DST_COLOR,[Ng]:i.DST_ALPHA,[Dg]:i.ONE_MINUS_SRC_COLOR,[cd]:i.ONE_MINUS_SRC_ALPHA,[Og]:i.ONE_MINUS_DST_COLOR,[Ug]:i.ONE_MINUS_DST_ALPHA,[zg]:i.CONSTANT_COLOR,[kg]:i.ONE_MINUS_CONSTANT_COLOR,[Vg]:i.CONSTANT_ALPHA,[Gg]:i.ONE_MINUS_CONSTANT_ALPHA};function Qe(k,st,et,wt,_t,Mt,Wt,Jt,lt,Ot){if(k===Er){m===!0&&(Ht(i.BLEND),m=!1);return}if(m===!1&&(St(i.BLEND),m=!0),k!==Tg){if(k!==p||Ot!==C){if((_!==Cr||w!==Cr)&&(i.blendEquation(i.FUNC_ADD),_=Cr,w=Cr),Ot)switch(k){case Do:i.blendFuncSeparate(i.ONE,i.ONE_MINUS_SRC_ALPHA,i.ONE,i.ONE_MINUS_SRC_ALPHA);break;case rd:i.blendFunc(i.ONE,i.ONE);break;case od:i.blendFuncSeparate(i.ZERO,i.ONE_MINUS_SRC_COLOR,i.ZERO,i.ONE);break;case ad:i.blendFuncSeparate(i.DST_COLOR,i.ONE_MINUS_SRC_ALPHA,i.ZERO,i.ONE);break;default:Qt("WebGLState: Invalid blending: ",k);break}else switch(k){case Do:i.blendFuncSeparate(i.SRC_ALPHA,i.ONE_MINUS_SRC_ALPHA,i.ONE,i.ONE_MINUS_SRC_ALPHA);break;case rd:i.blendFuncSeparate(i.SRC_ALPHA,i.ONE,i.ONE,i.ONE);break;case od:Qt("WebGLState: SubtractiveBlending requires material.premultipliedAlpha = true");break;case ad:Qt("WebGLState: MultiplyBlending requires material.premultipliedAlpha = true");break;default:Qt("WebGLState: Invalid blending: ",k);break}M=null,y=null,T=null,x=null,b.set(0,0,0),D=0,p=k,C=Ot}return}_t=_t||st,Mt=Mt||et,Wt=Wt||wt,(st!==_||_t!==w)&&(i.blendEquationSeparate(he[st],he[_t]),_=st,w=_t),(et!==M||wt!==y||Mt!==T||Wt!==x)&&(i.blendFuncSeparate(se[et],se[wt],se[Mt],se[Wt]),M=et,y=wt,T=Mt,x=Wt),(Jt.equals(b)===!1||lt!==D)&&(i.blendColor(Jt.r,Jt.g,Jt.b,lt),b.copy(Jt),D=lt),p=k,C=!1}function We(k,st){k.side===$n?Ht(i.CULL_FACE):St(i.CULL_FACE);let et=k.side===Cn;st&&(et=!et),gn(et),k.blending===Do&&k.transparent===!1?Qe(Er):Qe(k.blending,k.blendEquation,k.blendSrc,k.blendDst,k.blendEquationAlpha,k.blendSrcAlpha,k.blendDstAlpha,k.blendColor,k.blendAlpha,k.premultipliedAlpha),o.setFunc(k.depthFunc),o.setTest(k.depthTest),o.setMask(k.depthWrite),r.setMask(k.colorWrite);let wt=k.stencilWrite;a.setTest(wt),wt&&(a.setMask(k.stencilWriteMask),a.setFunc(k.stencilFunc,k.stencilRef,k.stencilFuncMask),a.setOp(k.stencilFail,k.stencilZFail,k.stencilZPass)),ve(k.polygonOffset,k.polygonOffsetFactor,k.polygonOffsetUnits),k.alphaToCoverage===!0?St(i.SAMPLE_ALPHA_TO_COVERAGE):Ht(i.SAMPLE_ALPHA_TO_COVERAGE)}function gn(k){P!==k&&(k?i.frontFace(i.CW):i.frontFace(i.CCW),P=k)}function Ue(k){k!==Mg?(St(i.CULL_FACE),k!==I&&(k===sd?i.cullFace(i.BACK):k===bg?i.cullFace(i.FRONT):i.cullFace(i.FRONT_AND_BACK))):Ht(i.CULL_FACE),I=k}function Nn(k){k!==O&&(H&&i.lineWidth(k),O=k)}function ve(k,st,et){k?(St(i.POLYGON_OFFSET_FILL),(L!==st||z!==et)&&(L=st,z=et,o.getReversed()&&(st=-st,et=-et),i.polygonOffset(st,et))):Ht(i.POLYGON_OFFSET_FILL)}function wn(k){k?St(i.SCISSOR_TEST):Ht(i.SCISSOR_TEST)}function rn(k){k===void 0&&(k=i.TEXTURE0+X-1),j!==k&&(i.activeTexture(k),j=k)}function _n(k,st,et){et===void 0&&(j===null?et=i.TEXTURE0+X-1:et=j);let wt=nt[et];wt===void 0&&(wt={type:void 0,texture:void 0},nt[et]=wt),(wt.type!==k||wt.texture!==st)&&(j!==et&&(i.activeTexture(et),j=et),i.bindTexture(k,st||Et[k]),wt.type=k,wt.texture=st)}function V(){let k=nt[j];k!==void 0&&k.type!==void 0&&(i.bindTexture(k.type,null),k.type=void 0,k.texture=void 0)}function Rt(){try{i.compressedTexImage2D(...arguments)}catch(k){Qt("WebGLState:",k)}}function Zt(){try{i.compressedTexImage3D(...arguments)}catch(k){Qt("WebGLState:",k)}}function oe(){try{i.texSubImage2D(...arguments)}catch(k){Qt("WebGLState:",k)}}function bt(){try{i.texSubImage3D(...arguments)}catch(k){Qt("WebGLState:",k)}}function ze(){try{i.compressedTexSubImage2D(...arguments)}catch(k){Qt("WebGLState:",k)}}function Gt(){try{i.compressedTexSubImage3D(...arguments)}catch(k){Qt("WebGLState:",k)}}function qt(){try{i.texStorage2D(...arguments)}catch(k){Qt("WebGLState:",k)}}function N(){try{i.texStorage3D(...arguments)}catch(k){Qt("WebGLState:",k)}}function A(){try{i.texImage2D(...arguments)}catch(k){Qt("WebGLState:",k)}}function q(){try{i.texImage3D(...arguments)}catch(k){Qt("WebGLState:",k)}}function ct(k){return u[k]!==void 0?u[k]:i.getParameter(k)}function rt(k,st){u[k]!==st&&(i.pixelStorei(k,st),u[k]=st)}function xt(k){Q.equals(k)===!1&&(i.scissor(k.x,k.y,k.z,k.w),Q.copy(k))}function yt(k){dt.equals(k)===!1&&(i.viewport(k.x,k.y,k.z,k.w),dt.copy(k))}function tt(k,st){let et=c.get(st);et===void 0&&(et=new WeakMap,c.set(st,et));let wt=et.get(k);wt===void 0&&(wt=i.getUniformBlockIndex(st,k.name),i.uniformBlockBinding(st,wt,wt),et.set(k,wt))}function it(k,st,et){let _t=c.get(st).get(k);l[_t]!==et&&(i.bindBufferBase(i.UNIFORM_BUFFER,_t,et),l[_t]=et)}function pt(){i.disable(i.BLEND),i.disable(i.CULL_FACE),i.disable(i.DEPTH_TEST),i.disable(i.POLYGON_OFFSET_FILL),i.disable(i.SCISSOR_TEST),i.disable(i.STENCIL_TEST),i.disable(i.SAMPLE_ALPHA_TO_COVERAGE),i.blendEquation(i.FUNC_ADD),i.blendFunc(i.ONE,i.ZERO),i.blendFuncSeparate(i.ONE,i.ZERO,i.ONE,i.ZERO),i.blendColor(0,0,0,0),i.colorMask(!0,!0,!0,!0),i.clearColor(0,0,0,0),i.depthMask(!0),i.depthFunc(i.LESS),o.setReversed(!1),i.clearDepth(1),i.stencilMask(4294967295),i.stencilFunc(i.ALWAYS,0,4294967295),i.stencilOp(i.KEEP,i.KEEP,i.KEEP),i.clearStencil(0),i.cullFace(i.BACK),i.frontFace(i.CCW),i.polygonOffset(0,0),i.activeTexture(i.TEXTURE0),i.bindFramebuffer(i.FRAMEBUFFER,null),i.bindFramebuffer(i.DRAW_FRAMEBUFFER,null),i.bindFramebuffer(i.READ_FRAMEBUFFER,null),i.useProgram(null),i.lineWidth(1),i.scissor(0,0,i.canvas.width,i.canvas.height),i.viewport(0,0,i.canvas.width,i.canvas.height),i.pixelStorei(i.PACK_ALIGNMENT,4),i.pixelStorei(i.UNPACK_ALIGNMENT,4),i.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,!1),i.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,!1),i.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,i.BROWSER_DEFAULT_WEBGL),i.pixelStorei(i.PACK_ROW_LENGTH,0),i.pixelStorei(i.PACK_SKIP_PIXELS,0),i.pixelStorei(i.PACK_SKIP_ROWS,0),i.pixelStorei(i.UNPACK_ROW_LENGTH,0),i.pixelStorei(i.UNPACK_IMAGE_HEIGHT,0),i.pixelStorei(i.UNPACK_SKIP_PIXELS,0),i.pixelStorei(i.UNPACK_SKIP_ROWS,0),i.pixelStorei(i.UNPACK_SKIP_IMAGES,0),f={},u={},j=null,nt={},h={},l={},d=new WeakMap,g=[],v=null,m=!1,p=null,_=null,M=null,y=null,w=null,T=null,x=null,b=new $t(0,0,0),D=0,C=!1,P=null,I=null,O=null,L=null,z=null,Q.set(0,0,i.canvas.width,i.canvas.height),dt.set(0,0,i.canvas.width,i.canvas.height),r.reset(),o.reset(),a.reset()}return{buffers:{color:r,depth:o,stencil:a},enable:St,disable:Ht,bindFramebuffer:ne,drawBuffers:Vt,useProgram:le,setBlending:Qe,setMaterial:We,setFlipSided:gn,setCullFace:Ue,setLineWidth:Nn,setPolygonOffset:ve,setScissorTest:wn,activeTexture:rn,bindTexture:_n,unbindTexture:V,compressedTexImage2D:Rt,compressedTexImage3D:Zt,texImage2D:A,texImage3D:q,pixelStorei:rt,getParameter:ct,updateUBOMapping:tt,uniformBlockBinding:it,texStorage2D:qt,texStorage3D:N,texSubImage2D:oe,texSubImage3D:bt,compressedTexSubImage2D:ze,compressedTexSubImage3D:Gt,scissor:xt,viewport:yt,reset:pt}}function E1(i,t,e,n,s,r,o){let a=t.has("WEBGL_multisampled_render_to_texture")?t.get("WEBGL_multisampled_render_to_texture"):null,l=typeof navigator>"u"?!1:/OculusBrowser/g.test(navigator.userAgent),c=new kt,f=new WeakMap,u=new Set,h,d=new WeakMap,g=new Set,v=new FinalizationRegistry(N=>g.delete(N)),m=!1;try{m=typeof OffscreenCanvas<"u"&&new OffscreenCanvas(1,1).getContext("2d")!==null}catch{}function p(N,A){return m?new OffscreenCanvas(N,A):Fa("canvas")}function _(N,A,q){let ct=1,rt=qt(N);if((rt.width>q||rt.height>q)&&(ct=q/Math.max(rt.width,rt.height)),ct<1)if(typeof HTMLImageElement<"u"&&N instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&N instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&N instanceof ImageBitmap||typeof VideoFrame<"u"&&N instanceof VideoFrame){let xt=Math.floor(ct*rt.width),yt=Math.floor(ct*rt.height);h===void 0&&(h=p(xt,yt));let tt=A?p(xt,yt):h;return tt.width=xt,tt.height=yt,tt.getContext("2d").drawImage(N,0,0,xt,yt),Yt("WebGLRenderer: Texture has been resized from ("+rt.width+"x"+rt.height+") to ("+xt+"x"+yt+")."),tt}else return"data"in N&&Yt("WebGLRenderer: Image in DataTexture is too big ("+rt.width+"x"+rt.height+")."),N;return N}function M(N){return N.generateMipmaps}function y(N){i.generateMipmap(N)}function w(N){return N.isWebGLCubeRenderTarget?i.TEXTURE_CUBE_MAP:N.isWebGL3DRenderTarget?i.TEXTURE_3D:N.isWebGLArrayRenderTarget||N.isCompressedArrayTexture?i.TEXTURE_2D_ARRAY:i.TEXTURE_2D}function T(N,A,q,ct,rt,xt=!1){if(N!==null){if(i[N]!==void 0)return i[N];Yt("WebGLRenderer: Attempt to use non-existing WebGL internal format '"+N+"'")}let yt;ct&&(yt=t.get("EXT_texture_norm16"),yt||Yt("WebGLRenderer: Unable to use normalized textures without EXT_texture_norm16 extension"));let tt=A;if(A===i.RED&&(q===i.FLOAT&&(tt=i.R32F),q===i.HALF_FLOAT&&(tt=i.R16F),q===i.UNSIGNED_BYTE&&(tt=i.R8),q===i.UNSIGNED_SHORT&&yt&&(tt=yt.R16_EXT),q===i.SHORT&&yt&&(tt=yt.R16_SNORM_EXT)),A===i.RED_INTEGER&&(q===i.UNSIGNED_BYTE&&(tt=i.R8UI),q===i.UNSIGNED_SHORT&&(tt=i.R16UI),q===i.UNSIGNED_INT&&(tt=i.R32UI),q===i.BYTE&&(tt=i.R8I),q===i.SHORT&&(tt=i.R16I),q===i.INT&&(tt=i.R32I)),A===i.RG&&(q===i.FLOAT&&(tt=i.RG32F),q===i.HALF_FLOAT&&(tt=i.RG16F),q===i.UNSIGNED_BYTE&&(tt=i.RG8),q===i.UNSIGNED_SHORT&&yt&&(tt=yt.RG16_EXT),q===i.SHORT&&yt&&(tt=yt.RG16_SNORM_EXT)),A===i.RG_INTEGER&&(q===i.UNSIGNED_BYTE&&(tt=i.RG8UI),q===i.UNSIGNED_SHORT&&(tt=i.RG16UI),q===i.UNSIGNED_INT&&(tt=i.RG32UI),q===i.BYTE&&(tt=i.RG8I),q===i.SHORT&&(tt=i.RG16I),q===i.INT&&(tt=i.RG32I)),A===i.RGB_INTEGER&&(q===i.UNSIGNED_BYTE&&(tt=i.RGB8UI),q===i.UNSIGNED_SHORT&&(tt=i.RGB16UI),q===i.UNSIGNED_INT&&(tt=i.RGB32UI),q===i.BYTE&&(tt=i.RGB8I),q===i.SHORT&&(tt=i.RGB16I),q===i.INT&&(tt=i.RGB32I)),A===i.RGBA_INTEGER&&(q===i.UNSIGNED_BYTE&&(tt=i.RGBA8UI),q===i.UNSIGNED_SHORT&&(tt=i.RGBA16UI),q===i.UNSIGNED_INT&&(tt=i.RGBA32UI),q===i.BYTE&&(tt=i.RGBA8I),q===i.SHORT&&(tt=i.RGBA16I),q===i.INT&&(tt=i.RGBA32I)),A===i.RGB&&(q===i.UNSIGNED_SHORT&&yt&&(tt=yt.RGB16_EXT),q===i.SHORT&&yt&&(tt=yt.RGB16_SNORM_EXT),q===i.UNSIGNED_INT_5_9_9_9_REV&&(tt=i.RGB9_E5),q===i.UNSIGNED_INT_10F_11F_11F_REV&&(tt=i.R11F_G11F_B10F)),A===i.RGBA){let it=xt?Ua:xe.getTransfer(rt);q===i.FLOAT&&(tt=i.RGBA32F),q===i.HALF_FLOAT&&(tt=i.RGBA16F),q===i.UNSIGNED_BYTE&&(tt=it===Re?i.SRGB8_ALPHA8:i.RGBA8),q===i.UNSIGNED_SHORT&&yt&&(tt=yt.RGBA16_EXT),q===i.SHORT&&yt&&(tt=yt.RGBA16_SNORM_EXT),q===i.UNSIGNED_SHORT_4_4_4_4&&(tt=i.RGBA4),q===i.UNSIGNED_SHORT_5_5_5_1&&(tt=i.RGB5_A1)}return(tt===i.R16F||tt===i.R32F||tt===i.RG16F||tt===i.RG32F||tt===i.RGBA16F||tt===i.RGBA32F)&&t.get("EXT_color_buffer_float"),tt}function x(N,A){let q;return N?A===null||A===Hi||A===Pr?q=i.DEPTH24_STENCIL8:A===ui?q=i.DEPTH32F_STENCIL8:A===Uo&&(q=i.DEPTH24_STENCIL8,Yt("DepthTexture: 16 bit depth attachment is not supported with stencil. Using 24-bit attachment.")):A===null||A===Hi||A===Pr?q=i.DEPTH_COMPONENT24:A===ui?q=i.DEPTH_COMPONENT32F:A===Uo&&(q=i.DEPTH_COMPONENT16),q}function b(N,A){return M(N)===!0||N.isFramebufferTexture&&N.minFilter!==Vn&&N.minFilter!==si?Math.log2(Math.max(A.width,A.height))+1:N.mipmaps.length>0?N.mipmaps.length:N.isCompressedTexture&&Array.isArray(N.image)?A.mipmaps.length:1}function D(N){let A=new WeakRef(N);n.get(N).__ref=A,g.add(A),v.register(N,A,A)}function C(N){let A=n.get(N).__ref;A!==void 0&&(g.delete(A),v.unregister(A))}function P(N){O(N.target)}function I(N){L(N.target)}function O(N){N.removeEventListener("dispose",P),C(N),X(N),N.isVideoTexture&&f.delete(N),N.isHTMLTexture&&u.delete(N)}function L(N){N.removeEventListener("dispose",I),C(N),at(N)}function z(){for(let N of g){let A=N.deref();A!==void 0&&(A.isRenderTarget===!0?L(A):O(A))}g.clear(),u.clear()}function X(N){let A=n.get(N);if(A.__webglInit===void 0)return;let q=N.source,ct=d.get(q);if(ct){let rt=ct[A.__cacheKey];rt.usedTimes--,rt.usedTimes===0&&H(N),Object.keys(ct).length===0&&d.delete(q)}n.remove(N)}function H(N){let A=n.get(N);i.deleteTexture(A.__webglTexture);let q=N.source,ct=d.get(q);delete ct[A.__cacheKey],o.memory.textures--}function at(N){let A=n.get(N);A.__depthDisposeCallback&&A.__depthDisposeCallback();let q=N.depthTexture;if(q&&q.renderTarget===N&&O(q),N.isWebGLCubeRenderTarget)for(let rt=0;rt<6;rt++){if(Array.isArray(A.__webglFramebuffer[rt]))for(let xt=0;xt<A.__webglFramebuffer[rt].length;xt++)i.deleteFramebuffer(A.__webglFramebuffer[rt][xt]);else i.deleteFramebuffer(A.__webglFramebuffer[rt]);A.__webglDepthbuffer&&i.deleteRenderbuffer(A.__webglDepthbuffer[rt])}else{if(Array.isArray(A.__webglFramebuffer))for(let rt=0;rt<A.__webglFramebuffer.length;rt++)i.deleteFramebuffer(A.__webglFramebuffer[rt]);else i.deleteFramebuffer(A.__webglFramebuffer);if(A.__webglDepthbuffer&&i.deleteRenderbuffer(A.__webglDepthbuffer),A.__webglMultisampledFramebuffer&&i.deleteFramebuffer(A.__webglMultisampledFramebuffer),A.__webglColorRenderbuffer)for(let rt=0;rt<A.__webglColorRenderbuffer.length;rt++)A.__webglColorRenderbuffer[rt]&&i.deleteRenderbuffer(A.__webglColorRenderbuffer[rt]);A.__webglDepthRenderbuffer&&i.deleteRenderbuffer(A.__webglDepthRenderbuffer)}let ct=N.textures;for(let rt=0,xt=ct.length;rt<xt;rt++){let yt=n.get(ct[rt]);yt.__webglTexture&&(i.deleteTexture(yt.__webglTexture),o.memory.textures--),n.remove(ct[rt])}n.remove(N)}let Z=0;function j(){Z=0}function nt(){return Z}function ut(N){Z=N}function ht(){let N=Z;return N>=s.maxTextures&&Yt("WebGLTextures: Trying to use "+(N+1)+" texture units while this GPU supports only "+s.maxTextures),Z+=1,N}function Q(N){let A=[];return A.push(N.wrapS),A.push(N.wrapT),A.push(N.wrapR||0),A.push(N.magFilter),A.push(N.minFilter),A.push(N.anisotropy),A.push(N.internalFormat),A.push(N.format),A.push(N.type),A.push(N.generateMipmaps),A.push(N.mipmapsAutoUpdate),A.push(N.premultiplyAlpha),A.push(N.flipY),A.push(N.unpackAlignment),A.push(N.colorSpace),A.join()}function dt(N,A){let q=n.get(N);if(N.isVideoTexture&&ze(N),N.isRenderTargetTexture===!1&&N.isExternalTexture!==!0&&N.version>0&&q.__version!==N.version){let ct=N.image;if(ct===null)Yt("WebGLRenderer: Texture marked for update but no image data found.");else if(ct.complete===!1)Yt("WebGLRenderer: Texture marked for update but image is incomplete");else{We(q,N,A);return}}else N.isExternalTexture&&(q.__webglTexture=N.sourceTexture?N.sourceTexture:null);e.bindTexture(i.TEXTURE_2D,q.__webglTexture,i.TEXTURE0+A)}function gt(N,A){let q=n.get(N);if(N.isRenderTargetTexture===!1&&N.version>0&&q.__version!==N.version){We(q,N,A);return}else N.isExternalTexture&&(q.__webglTexture=N.sourceTexture?N.sourceTexture:null);e.bindTexture(i.TEXTURE_2D_ARRAY,q.__webglTexture,i.TEXTURE0+A)}function Et(N,A){let q=n.get(N);if(N.isRenderTargetTexture===!1&&N.version>0&&q.__version!==N.version){We(q,N,A);return}e.bindTexture(i.TEXTURE_3D,q.__webglTexture,i.TEXTURE0+A)}function St(N,A){let q=n.get(N);if(N.version>0&&q.__version!==N.version){gn(q,N,A);return}e.bindTexture(i.TEXTURE_CUBE_MAP,q.__webglTexture,i.TEXTURE0+A)}let Ht={[vc]:i.REPEAT,[rs]:i.CLAMP_TO_EDGE,[Sc]:i.MIRRORED_REPEAT},ne={[Vn]:i.NEAREST,[Xg]:i.NEAREST_MIPMAP_NEAREST,[sl]:i.NEAREST_MIPMAP_LINEAR,[si]:i.LINEAR,[Yc]:i.LINEAR_MIPMAP_NEAREST,[Ns]:i.LINEAR_MIPMAP_LINEAR},Vt={[Zg]:i.NEVER,[Pd]:i.ALWAYS,[$g]:i.LESS,[Cd]:i.LEQUAL,[Kg]:i.EQUAL,[Rd]:i.GEQUAL,[Jg]:i.GREATER,[jg]:i.NOTEQUAL};function le(N,A){if(A.type===ui&&t.has("OES_texture_float_linear")===!1&&(A.magFilter===si||A.magFilter===Yc||A.magFilter===sl||A.magFilter===Ns||A.minFilter===si||A.minFilter===Yc||A.minFilter===sl||A.minFilter===Ns)&&Yt("WebGLRenderer: Unable to use linear filtering with floating point textures. OES_texture_float_linear not supported on this device."),i.texParameteri(N,i.TEXTURE_WRAP_S,Ht[A.wrapS]),i.texParameteri(N,i.TEXTURE_WRAP_T,Ht[A.wrapT]),(N===i.TEXTURE_3D||N===i.TEXTURE_2D_ARRAY)&&i.texParameteri(N,i.TEXTURE_WRAP_R,Ht[A.wrapR]),i.texParameteri(N,i.TEXTURE_MAG_FILTER,ne[A.magFilter]),i.texParameteri(N,i.TEXTURE_MIN_FILTER,ne[A.minFilter]),A.compareFunction&&(i.texParameteri(N,i.TEXTURE_COMPARE_MODE,i.COMPARE_REF_TO_TEXTURE),i.texParameteri(N,i.TEXTURE_COMPARE_FUNC,Vt[A.compareFunction])),t.has("EXT_texture_filter_anisotropic")===!0){if(A.magFilter===Vn||A.minFilter!==sl&&A.minFilter!==Ns||A.type===ui&&t.has("OES_texture_float_linear")===!1)return;if(A.anisotropy>1||n.get(A).__currentAnisotropy){let q=t.get("EXT_texture_filter_anisotropic");i.texParameterf(N,q.TEXTURE_MAX_ANISOTROPY_EXT,Math.min(A.anisotropy,s.getMaxAnisotropy())),n.get(A).__currentAnisotropy=A.anisotropy}}}function he(N,A){let q=!1;N.__webglInit===void 0&&(N.__webglInit=!0,A.addEventListener("dispose",P),D(A));let ct=A.source,rt=d.get(ct);rt===void 0&&(rt={},d.set(ct,rt));let xt=Q(A);if(xt!==N.__cacheKey){rt[xt]===void 0&&(rt[xt]={texture:i.createTexture(),usedTimes:0},o.memory.textures++,q=!0),rt[xt].usedTimes++;let yt=rt[N.__cacheKey];yt!==void 0&&(rt[N.__cacheKey].usedTimes--,yt.usedTimes===0&&H(A)),N.__cacheKey=xt,N.__webglTexture=rt[xt].texture}return q}function se(N,A,q){return Math.floor(Math.floor(N/q)/A)}function Qe(N,A,q,ct){let xt=N.updateRanges;if(xt.length===0)e.texSubImage2D(i.TEXTURE_2D,0,0,0,A.width,A.height,q,ct,A.data);else{xt.sort((k,st)=>k.start-st.start);let yt=0;for(let k=1;k<xt.length;k++){let st=xt[yt],et=xt[k],wt=st.start+st.count,_t=se(et.start,A.width,4),Mt=se(st.start,A.width,4);et.start<=wt+1&&_t===Mt&&se(et.start+et.count-1,A.width,4)===_t?st.count=Math.max(st.count,et.start+et.count-st.start):(++yt,xt[yt]=et)}xt.length=yt+1;let tt=e.getParameter(i.UNPACK_ROW_LENGTH),it=e.getParameter(i.UNPACK_SKIP_PIXELS),pt=e.getParameter(i.UNPACK_SKIP_ROWS);e.pixelStorei(i.UNPACK_ROW_LENGTH,A.width);for(let k=0,st=xt.length;k<st;k++){let et=xt[k],wt=Math.floor(et.start/4),_t=Math.ceil(et.count/4),Mt=wt%A.width,Wt=Math.floor(wt/A.width),Jt=_t,lt=1;e.pixelStorei(i.UNPACK_SKIP_PIXELS,Mt),e.pixelStorei(i.UNPACK_SKIP_ROWS,Wt),e.texSubImage2D(i.TEXTURE_2D,0,Mt,Wt,Jt,lt,q,ct,A.data)}N.clearUpdateRanges(),e.pixelStorei(i.UNPACK_ROW_LENGTH,tt),e.pixelStorei(i.UNPACK_SKIP_PIXELS,it),e.pixelStorei(i.UNPACK_SKIP_ROWS,pt)}}function We(N,A,q){let ct=i.TEXTURE_2D;(A.isDataArrayTexture||A.isCompressedArrayTexture)&&(ct=i.TEXTURE_2D_ARRAY),A.isData3DTexture&&(ct=i.TEXTURE_3D);let rt=he(N,A),xt=A.source;e.bindTexture(ct,N.__webglTexture,i.TEXTURE0+q);let yt=n.get(xt);if(xt.version!==yt.__version||rt===!0){if(e.activeTexture(i.TEXTURE0+q),(typeof ImageBitmap<"u"&&A.image instanceof ImageBitmap)===!1){let lt=xe.getPrimaries(xe.workingColorSpace),Ot=A.colorSpace===Fs?null:xe.getPrimaries(A.colorSpace),jt=A.colorSpace===Fs||lt===Ot?i.NONE:i.BROWSER_DEFAULT_WEBGL;e.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,A.flipY),e.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,A.premultiplyAlpha),e.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,jt)}e.pixelStorei(i.UNPACK_ALIGNMENT,A.unpackAlignment);let it=_(A.image,!1,s.maxTextureSize);it=Gt(A,it);let pt=r.convert(A.format,A.colorSpace),k=r.convert(A.type),st=T(A.internalFormat,pt,k,A.normalized,A.colorSpace,A.isVideoTexture);le(ct,A);let et,wt=A.mipmaps,_t=A.isVideoTexture!==!0,Mt=yt.__version===void 0||rt===!0,Wt=xt.dataReady,Jt=b(A,it);if(A.isDepthTexture)st=x(A.format===Us,A.type),Mt&&(_t?e.texStorage2D(i.TEXTURE_2D,1,st,it.width,it.height):e.texImage2D(i.TEXTURE_2D,0,st,it.width,it.height,0,pt,k,null));else if(A.isDataTexture)if(wt.length>0){_t&&Mt&&e.texStorage2D(i.TEXTURE_2D,Jt,st,wt[0].width,wt[0].height);for(let lt=0,Ot=wt.length;lt<Ot;lt++)et=wt[lt],_t?Wt&&e.texSubImage2D(i.TEXTURE_2D,lt,0,0,et.width,et.height,pt,k,et.data):e.texImage2D(i.TEXTURE_2D,lt,st,et.width,et.height,0,pt,k,et.data);A.generateMipmaps=!1}else _t?(Mt&&e.texStorage2D(i.TEXTURE_2D,Jt,st,it.width,it.height),Wt&&Qe(A,it,pt,k)):e.texImage2D(i.TEXTURE_2D,0,st,it.width,it.height,0,pt,k,it.data);else if(A.isCompressedTexture)if(A.isCompressedArrayTexture){_t&&Mt&&e.texStorage3D(i.TEXTURE_2D_ARRAY,Jt,st,wt[0].width,wt[0].height,it.depth);for(let lt=0,Ot=wt.length;lt<Ot;lt++)if(et=wt[lt],A.format!==Xi)if(pt!==null)if(_t){if(Wt)if(A.layerUpdates.size>0){let jt=kd(et.width,et.height,A.format,A.type);for(let Ct of A.layerUpdates){let ce=et.data.subarray(Ct*jt/et.data.BYTES_PER_ELEMENT,(Ct+1)*jt/et.data.BYTES_PER_ELEMENT);e.compressedTexSubImage3D(i.TEXTURE_2D_ARRAY,lt,0,0,Ct,et.width,et.height,1,pt,ce)}}else e.compressedTexSubImage3D(i.TEXTURE_2D_ARRAY,lt,0,0,0,et.width,et.height,it.depth,pt,et.data)}else e.compressedTexImage3D(i.TEXTURE_2D_ARRAY,lt,st,et.width,et.height,it.depth,0,et.data,0,0);else Yt("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()");else _t?Wt&&e.texSubImage3D(i.TEXTURE_2D_ARRAY,lt,0,0,0,et.width,et.height,it.depth,pt,k,et.data):e.texImage3D(i.TEXTURE_2D_ARRAY,lt,st,et.width,et.height,it.depth,0,pt,k,et.data);A.layerUpdates.size>0&&A.clearLayerUpdates()}else{_t&&Mt&&e.texStorage2D(i.TEXTURE_2D,Jt,st,wt[0].width,wt[0].height);for(let lt=0,Ot=wt.length;lt<Ot;lt++)et=wt[lt],A.format!==Xi?pt!==null?_t?Wt&&e.compressedTexSubImage2D(i.TEXTURE_2D,lt,0,0,et.width,et.height,pt,et.data):e.compressedTexImage2D(i.TEXTURE_2D,lt,st,et.width,et.height,0,et.data):Yt("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()"):_t?Wt&&e.texSubImage2D(i.TEXTURE_2D,lt,0,0,et.width,et.height,pt,k,et.data):e.texImage2D(i.TEXTURE_2D,lt,st,et.width,et.height,0,pt,k,et.data)}else if(A.isDataArrayTexture)if(_t){if(Mt&&e.texStorage3D(i.TEXTURE_2D_ARRAY,Jt,st,it.width,it.height,it.depth),Wt)if(A.layerUpdates.size>0){let lt=kd(it.width,it.height,A.format,A.type);for(let Ot of A.layerUpdates){let jt=it.data.subarray(Ot*lt/it.data.BYTES_PER_ELEMENT,(Ot+1)*lt/it.data.BYTES_PER_ELEMENT);e.texSubImage3D(i.TEXTURE_2D_ARRAY,0,0,0,Ot,it.width,it.height,1,pt,k,jt)}A.clearLayerUpdates()}else e.texSubImage3D(i.TEXTURE_2D_ARRAY,0,0,0,0,it.width,it.height,it.depth,pt,k,it.data)}else e.texImage3D(i.TEXTURE_2D_ARRAY,0,st,it.width,it.height,it.depth,0,pt,k,it.data);else if(A.isData3DTexture)_t?(Mt&&e.texStorage3D(i.TEXTURE_3D,Jt,st,it.width,it.height,it.depth),Wt&&e.texSubImage3D(i.TEXTURE_3D,0,0,0,0,it.width,it.height,it.depth,pt,k,it.data)):e.texImage3D(i.TEXTURE_3D,0,st,it.width,it.height,it.depth,0,pt,k,it.data);else if(A.isFramebufferTexture){if(Mt)if(_t)e.texStorage2D(i.TEXTURE_2D,Jt,st,it.width,it.height);else{let lt=it.width,Ot=it.height;for(let jt=0;jt<Jt;jt++)e.texImage2D(i.TEXTURE_2D,jt,st,lt,Ot,0,pt,k,null),lt>>=1,Ot>>=1}}else if(A.isHTMLTexture){if("texElementImage2D"in i){let lt=i.canvas;if(lt.hasAttribute("layoutsubtree")||lt.setAttribute("layoutsubtree","true"),it.parentNode!==lt){lt.appendChild(it),u.add(A),lt.onpaint=Ot=>{let jt=Ot.changedElements;for(let Ct of u)jt.includes(Ct.image)&&(Ct.needsUpdate=!0)},lt.requestPaint();return}if(i.texElementImage2D.length===3)i.texElementImage2D(i.TEXTURE_2D,i.RGBA8,it);else{let jt=i.RGBA,Ct=i.RGBA,ce=i.UNSIGNED_BYTE;i.texElementImage2D(i.TEXTURE_2D,0,jt,Ct,ce,it)}i.texParameteri(i.TEXTURE_2D,i.TEXTURE_MIN_FILTER,i.LINEAR),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_WRAP_S,i.CLAMP_TO_EDGE),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_WRAP_T,i.CLAMP_TO_EDGE)}}else if(wt.length>0){if(_t&&Mt){let lt=qt(wt[0]);e.texStorage2D(i.TEXTURE_2D,Jt,st,lt.width,lt.height)}for(let lt=0,Ot=wt.length;lt<Ot;lt++)et=wt[lt],_t?Wt&&e.texSubImage2D(i.TEXTURE_2D,lt,0,0,pt,k,et):e.texImage2D(i.TEXTURE_2D,lt,st,pt,k,et);A.generateMipmaps=!1}else if(_t){if(Mt){let lt=qt(it);e.texStorage2D(i.TEXTURE_2D,Jt,st,lt.width,lt.height)}Wt&&e.texSubImage2D(i.TEXTURE_2D,0,0,0,pt,k,it)}else e.texImage2D(i.TEXTURE_2D,0,st,pt,k,it);M(A)&&A.mipmapsAutoUpdate===!0&&y(ct),yt.__version=xt.version,A.onUpdate&&A.onUpdate(A)}N.__version=A.version}function gn(N,A,q){if(A.image.length!==6)return;let ct=he(N,A),rt=A.source;e.bindTexture(i.TEXTURE_CUBE_MAP,N.__webglTexture,i.TEXTURE0+q);let xt=n.get(rt);if(rt.version!==xt.__version||ct===!0){e.activeTexture(i.TEXTURE0+q);let yt=xe.getPrimaries(xe.workingColorSpace),tt=A.colorSpace===Fs?null:xe.getPrimaries(A.colorSpace),it=A.colorSpace===Fs||yt===tt?i.NONE:i.BROWSER_DEFAULT_WEBGL;e.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,A.flipY),e.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,A.premultiplyAlpha),e.pixelStorei(i.UNPACK_ALIGNMENT,A.unpackAlignment),e.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,it);let pt=A.isCompressedTexture||A.image[0].isCompressedTexture,k=A.image[0]&&A.image[0].isDataTexture,st=[];for(let Ct=0;Ct<6;Ct++)!pt&&!k?st[Ct]=_(A.image[Ct],!0,s.maxCubemapSize):st[Ct]=k?A.image[Ct].image:A.image[Ct],st[Ct]=Gt(A,st[Ct]);let et=st[0],wt=r.convert(A.format,A.colorSpace),_t=r.convert(A.type),Mt=T(A.internalFormat,wt,_t,A.normalized,A.colorSpace),Wt=A.isVideoTexture!==!0,Jt=xt.__version===void 0||ct===!0,lt=rt.dataReady,Ot=b(A,et);le(i.TEXTURE_CUBE_MAP,A);let jt;if(A.isDepthTexture){if(Mt=x(A.format===Us,A.type),Jt)if(Wt)e.texStorage2D(i.TEXTURE_CUBE_MAP,1,Mt,et.width,et.height);else for(let Ct=0;Ct<6;Ct++)e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ct,0,Mt,et.width,et.height,0,wt,_t,null)}else if(pt){Wt&&Jt&&e.texStorage2D(i.TEXTURE_CUBE_MAP,Ot,Mt,et.width,et.height);for(let Ct=0;Ct<6;Ct++){jt=st[Ct].mipmaps;for(let ce=0;ce<jt.length;ce++){let qe=jt[ce];A.format!==Xi?wt!==null?Wt?lt&&e.compressedTexSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ct,ce,0,0,qe.width,qe.height,wt,qe.data):e.compressedTexImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ct,ce,Mt,qe.width,qe.height,0,qe.data):Yt("WebGLRenderer: Attempt to load unsupported compressed texture format in .setTextureCube()"):Wt?lt&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ct,ce,0,0,qe.width,qe.height,wt,_t,qe.data):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ct,ce,Mt,qe.width,qe.height,0,wt,_t,qe.data)}}}else{if(jt=A.mipmaps,Wt&&Jt){jt.length>0&&Ot++;let Ct=qt(st[0]);e.texStorage2D(i.TEXTURE_CUBE_MAP,Ot,Mt,Ct.width,Ct.height)}for(let Ct=0;Ct<6;Ct++)if(k){Wt?lt&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ct,0,0,0,st[Ct].width,st[Ct].height,wt,_t,st[Ct].data):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ct,0,Mt,st[Ct].width,st[Ct].height,0,wt,_t,st[Ct].data);for(let ce=0;ce<jt.length;ce++){let jn=jt[ce].image[Ct].image;Wt?lt&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ct,ce+1,0,0,jn.width,jn.height,wt,_t,jn.data):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ct,ce+1,Mt,jn.width,jn.height,0,wt,_t,jn.data)}}else{Wt?lt&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ct,0,0,0,wt,_t,st[Ct]):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ct,0,Mt,wt,_t,st[Ct]);for(let ce=0;ce<jt.length;ce++){let qe=jt[ce];Wt?lt&&e.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ct,ce+1,0,0,wt,_t,qe.image[Ct]):e.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ct,ce+1,Mt,wt,_t,qe.image[Ct])}}}M(A)&&A.mipmapsAutoUpdate===!0&&y(i.TEXTURE_CUBE_MAP),xt.__version=rt.version,A.onUpdate&&A.onUpdate(A)}N.__version=A.version}function Ue(N,A,q,ct,rt,xt){let yt=r.convert(q.format,q.colorSpace),tt=r.convert(q.type),it=T(q.internalFormat,yt,tt,q.normalized,q.colorSpace),pt=n.get(A),k=n.get(q);if(k.__renderTarget=A,!pt.__hasExternalTextures){let st=Math.max(1,A.width>>xt),et=Math.max(1,A.height>>xt);rt===i.TEXTURE_3D||rt===i.TEXTURE_2D_ARRAY?e.texImage3D(rt,xt,it,st,et,A.depth,0,yt,tt,null):e.texImage2D(rt,xt,it,st,et,0,yt,tt,null)}e.bindFramebuffer(i.FRAMEBUFFER,N),bt(A)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,ct,rt,k.__webglTexture,0,oe(A)):(rt===i.TEXTURE_2D||rt>=i.TEXTURE_CUBE_MAP_POSITIVE_X&&rt<=i.TEXTURE_CUBE_MAP_NEGATIVE_Z)&&i.framebufferTexture2D(i.FRAMEBUFFER,ct,rt,k.__webglTexture,xt),e.bindFramebuffer(i.FRAMEBUFFER,null)}function Nn(N,A,q){if(i.bindRenderbuffer(i.RENDERBUFFER,N),A.depthBuffer){let ct=A.depthTexture,rt=ct&&ct.isDepthTexture?ct.type:null,xt=x(A.stencilBuffer,rt),yt=A.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;bt(A)?a.renderbufferStorageMultisampleEXT(i.RENDERBUFFER,oe(A),xt,A.width,A.height):q?i.renderbufferStorageMultisample(i.RENDERBUFFER,oe(A),xt,A.width,A.height):i.renderbufferStorage(i.RENDERBUFFER,xt,A.width,A.height),i.framebufferRenderbuffer(i.FRAMEBUFFER,yt,i.RENDERBUFFER,N)}else{let ct=A.textures;for(let rt=0;rt<ct.length;rt++){let xt=ct[rt],yt=r.convert(xt.format,xt.colorSpace),tt=r.convert(xt.type),it=T(xt.internalFormat,yt,tt,xt.normalized,xt.colorSpace);bt(A)?a.renderbufferStorageMultisampleEXT(i.RENDERBUFFER,oe(A),it,A.width,A.height):q?i.renderbufferStorageMultisample(i.RENDERBUFFER,oe(A),it,A.width,A.height):i.renderbufferStorage(i.RENDERBUFFER,it,A.width,A.height)}}i.bindRenderbuffer(i.RENDERBUFFER,null)}function ve(N,A,q){let ct=A.isWebGLCubeRenderTarget===!0;if(e.bindFramebuffer(i.FRAMEBUFFER,N),!(A.depthTexture&&A.depthTexture.isDepthTexture))throw new Error("THREE.WebGLTextures: renderTarget.depthTexture must be an instance of THREE.DepthTexture.");let rt=n.get(A.depthTexture);rt.__renderTarget=A;let xt=ct?A.depthTexture.image[0]:A.depthTexture.image;(!rt.__webglTexture||xt.width!==A.width||xt.height!==A.height)&&(xt.width=A.width,xt.height=A.height,A.depthTexture.needsUpdate=!0),ct?St(A.depthTexture,0):dt(A.depthTexture,0);let yt=rt.__webglTexture,tt=oe(A),it=ct?i.TEXTURE_CUBE_MAP_POSITIVE_X+q:i.TEXTURE_2D,pt=A.depthTexture.format===Us?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;if(A.depthTexture.format===Rs)bt(A)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,pt,it,yt,0,tt):i.framebufferTexture2D(i.FRAMEBUFFER,pt,it,yt,0);else if(A.depthTexture.format===Us)bt(A)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,pt,it,yt,0,tt):i.framebufferTexture2D(i.FRAMEBUFFER,pt,it,yt,0);else throw new Error("THREE.WebGLTextures: Unknown depthTexture format.")}function wn(N){let A=n.get(N),q=N.isWebGLCubeRenderTarget===!0;if(A.__boundDepthTexture!==N.depthTexture){let ct=N.depthTexture;if(A.__depthDisposeCallback&&A.__depthDisposeCallback(),ct){let rt=()=>{delete A.__boundDepthTexture,delete A.__depthDisposeCallback,ct.removeEventListener("dispose",rt)};ct.addEventListener("dispose",rt),A.__depthDisposeCallback=rt}A.__boundDepthTexture=ct}if(N.depthTexture&&!A.__autoAllocateDepthBuffer)if(q)for(let ct=0;ct<6;ct++)ve(A.__webglFramebuffer[ct],N,ct);else N.texture.mipmaps.length>0?ve(A.__webglFramebuffer[0],N,0):ve(A.__webglFramebuffer,N,0);else if(q){A.__webglDepthbuffer=[];for(let ct=0;ct<6;ct++)if(e.bindFramebuffer(i.FRAMEBUFFER,A.__webglFramebuffer[ct]),A.__webglDepthbuffer[ct]===void 0)A.__webglDepthbuffer[ct]=i.createRenderbuffer(),Nn(A.__webglDepthbuffer[ct],N,!1);else{let rt=N.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,xt=A.__webglDepthbuffer[ct];i.bindRenderbuffer(i.RENDERBUFFER,xt),i.framebufferRenderbuffer(i.FRAMEBUFFER,rt,i.RENDERBUFFER,xt)}}else if(N.texture.mipmaps.length>0?e.bindFramebuffer(i.FRAMEBUFFER,A.__webglFramebuffer[0]):e.bindFramebuffer(i.FRAMEBUFFER,A.__webglFramebuffer),A.__webglDepthbuffer===void 0)A.__webglDepthbuffer=i.createRenderbuffer(),Nn(A.__webglDepthbuffer,N,!1);else{let rt=N.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,xt=A.__webglDepthbuffer;i.bindRenderbuffer(i.RENDERBUFFER,xt),i.framebufferRenderbuffer(i.FRAMEBUFFER,rt,i.RENDERBUFFER,xt)}e.bindFramebuffer(i.FRAMEBUFFER,null)}function rn(N,A,q){let ct=n.get(N);A!==void 0&&Ue(ct.__webglFramebuffer,N,N.texture,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,0),q!==void 0&&wn(N)}function _n(N){let A=N.texture,q=n.get(N),ct=n.get(A);N.addEventListener("dispose",I),D(N);let rt=N.textures,xt=N.isWebGLCubeRenderTarget===!0,yt=rt.length>1;if(yt||(ct.__webglTexture===void 0&&(ct.__webglTexture=i.createTexture()),ct.__version=A.version,o.memory.textures++),xt){q.__webglFramebuffer=[];for(let tt=0;tt<6;tt++)if(A.mipmaps.length>0){q.__webglFramebuffer[tt]=[];for(let it=0;it<A.mipmaps.length;it++)q.__webglFramebuffer[tt][it]=i.createFramebuffer()}else q.__webglFramebuffer[tt]=i.createFramebuffer()}else{if(A.mipmaps.length>0){q.__webglFramebuffer=[];for(let tt=0;tt<A.mipmaps.length;tt++)q.__webglFramebuffer[tt]=i.createFramebuffer()}else q.__webglFramebuffer=i.createFramebuffer();if(yt)for(let tt=0,it=rt.length;tt<it;tt++){let pt=n.get(rt[tt]);pt.__webglTexture===void 0&&(pt.__webglTexture=i.createTexture(),o.memory.textures++)}if(N.samples>0&&bt(N)===!1){q.__webglMultisampledFramebuffer=i.createFramebuffer(),q.__webglColorRenderbuffer=[],e.bindFramebuffer(i.FRAMEBUFFER,q.__webglMultisampledFramebuffer);for(let tt=0;tt<rt.length;tt++){let it=rt[tt];q.__webglColorRenderbuffer[tt]=i.createRenderbuffer(),i.bindRenderbuffer(i.RENDERBUFFER,q.__webglColorRenderbuffer[tt]);let pt=r.convert(it.format,it.colorSpace),k=r.convert(it.type),st=T(it.internalFormat,pt,k,it.normalized,it.colorSpace,N.isXRRenderTarget===!0),et=oe(N);i.renderbufferStorageMultisample(i.RENDERBUFFER,et,st,N.width,N.height),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+tt,i.RENDERBUFFER,q.__webglColorRenderbuffer[tt])}i.bindRenderbuffer(i.RENDERBUFFER,null),N.depthBuffer&&(q.__webglDepthRenderbuffer=i.createRenderbuffer(),Nn(q.__webglDepthRenderbuffer,N,!0)),e.bindFramebuffer(i.FRAMEBUFFER,null)}}if(xt){e.bindTexture(i.TEXTURE_CUBE_MAP,ct.__webglTexture),le(i.TEXTURE_CUBE_MAP,A);for(let tt=0;tt<6;tt++)if(A.mipmaps.length>0)for(let it=0;it<A.mipmaps.length;it++)Ue(q.__webglFramebuffer[tt][it],N,A,i.COLOR_ATTACHMENT0,i.TEXTURE_CUBE_MAP_POSITIVE_X+tt,it);else Ue(q.__webglFramebuffer[tt],N,A,i.COLOR_ATTACHMENT0,i.TEXTURE_CUBE_MAP_POSITIVE_X+tt,0);M(A)?y(i.TEXTURE_CUBE_MAP):A.mipmaps.length>0&&i.texParameteri(i.TEXTURE_CUBE_MAP,i.TEXTURE_MAX_LEVEL,A.mipmaps.length-1),e.unbindTexture()}else if(yt){for(let tt=0,it=rt.length;tt<it;tt++){let pt=rt[tt],k=n.get(pt),st=i.TEXTURE_2D;(N.isWebGL3DRenderTarget||N.isWebGLArrayRenderTarget)&&(st=N.isWebGL3DRenderTarget?i.TEXTURE_3D:i.TEXTURE_2D_ARRAY),e.bindTexture(st,k.__webglTexture),le(st,pt),Ue(q.__webglFramebuffer,N,pt,i.COLOR_ATTACHMENT0+tt,st,0),M(pt)&&y(st)}e.unbindTexture()}else{let tt=i.TEXTURE_2D;if((N.isWebGL3DRenderTarget||N.isWebGLArrayRenderTarget)&&(tt=N.isWebGL3DRenderTarget?i.TEXTURE_3D:i.TEXTURE_2D_ARRAY),e.bindTexture(tt,ct.__webglTexture),le(tt,A),A.mipmaps.length>0)for(let it=0;it<A.mipmaps.length;it++)Ue(q.__webglFramebuffer[it],N,A,i.COLOR_ATTACHMENT0,tt,it);else Ue(q.__webglFramebuffer,N,A,i.COLOR_ATTACHMENT0,tt,0);M(A)?y(tt):A.mipmaps.length>0&&i.texParameteri(tt,i.TEXTURE_MAX_LEVEL,A.mipmaps.length-1),e.unbindTexture()}N.depthBuffer&&wn(N)}function V(N){let A=N.textures;for(let q=0,ct=A.length;q<ct;q++){let rt=A[q];if(M(rt)&&rt.mipmapsAutoUpdate===!0){let xt=w(N),yt=n.get(rt).__webglTexture;e.bindTexture(xt,yt),y(xt),e.unbindTexture()}}}let Rt=[];function Zt(N){if(N.samples>0){if(bt(N)===!1){let A=N.textures,q=N.width,ct=N.height,rt=i.COLOR_BUFFER_BIT,xt=N.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,yt=n.get(N),tt=A.length>1;if(tt)for(let pt=0;pt<A.length;pt++)e.bindFramebuffer(i.FRAMEBUFFER,yt.__webglMultisampledFramebuffer),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+pt,i.RENDERBUFFER,null),e.bindFramebuffer(i.FRAMEBUFFER,yt.__webglFramebuffer),i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0+pt,i.TEXTURE_2D,null,0);e.bindFramebuffer(i.READ_FRAMEBUFFER,yt.__webglMultisampledFramebuffer),N.texture.mipmaps.length>0?e.bindFramebuffer(i.DRAW_FRAMEBUFFER,yt.__webglFramebuffer[0]):e.bindFramebuffer(i.DRAW_FRAMEBUFFER,yt.__webglFramebuffer);for(let pt=0;pt<A.length;pt++){if(N.resolveDepthBuffer&&(N.depthBuffer&&(rt|=i.DEPTH_BUFFER_BIT),N.stencilBuffer&&N.resolveStencilBuffer&&(rt|=i.STENCIL_BUFFER_BIT)),tt){i.framebufferRenderbuffer(i.READ_FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.RENDERBUFFER,yt.__webglColorRenderbuffer[pt]);let k=n.get(A[pt]).__webglTexture;i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,k,0)}i.blitFramebuffer(0,0,q,ct,0,0,q,ct,rt,i.NEAREST),l===!0&&(Rt.length=0,Rt.push(i.COLOR_ATTACHMENT0+pt),N.depthBuffer&&N.storeMultisampledDepthBuffer===!1&&Rt.push(xt),i.invalidateFramebuffer(i.READ_FRAMEBUFFER,Rt))}if(e.bindFramebuffer(i.READ_FRAMEBUFFER,null),e.bindFramebuffer(i.DRAW_FRAMEBUFFER,null),tt)for(let pt=0;pt<A.length;pt++){e.bindFramebuffer(i.FRAMEBUFFER,yt.__webglMultisampledFramebuffer),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+pt,i.RENDERBUFFER,yt.__webglColorRenderbuffer[pt]);let k=n.get(A[pt]).__webglTexture;e.bindFramebuffer(i.FRAMEBUFFER,yt.__webglFramebuffer),i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0+pt,i.TEXTURE_2D,k,0)}e.bindFramebuffer(i.DRAW_FRAMEBUFFER,yt.__webglMultisampledFramebuffer)}else if(N.depthBuffer&&N.storeMultisampledDepthBuffer===!1&&l){let A=N.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;i.invalidateFramebuffer(i.DRAW_FRAMEBUFFER,[A])}}}function oe(N){return Math.min(s.maxSamples,N.samples)}function bt(N){let A=n.get(N);return N.samples>0&&t.has("WEBGL_multisampled_render_to_texture")===!0&&A.__useRenderToTexture!==!1}function ze(N){let A=o.render.frame;f.get(N)!==A&&(f.set(N,A),N.update())}function Gt(N,A){let q=N.colorSpace,ct=N.format,rt=N.type;return N.isCompressedTexture===!0||N.isVideoTexture===!0||q!==Na&&q!==Fs&&(xe.getTransfer(q)===Re?(ct!==Xi||rt!==hi)&&Yt("WebGLTextures: sRGB encoded textures have to use RGBAFormat and UnsignedByteType."):Qt("WebGLTextures: Unsupported texture color space:",q)),A}function qt(N){return typeof HTMLImageElement<"u"&&N instanceof HTMLImageElement?(c.width=N.naturalWidth||N.width,c.height=N.naturalHeight||N.height):typeof VideoFrame<"u"&&N instanceof VideoFrame?(c.width=N.displayWidth,c.height=N.displayHeight):(c.width=N.width,c.height=N.height),c}this.allocateTextureUnit=ht,this.resetTextureUnits=j,this.getTextureUnits=nt,this.setTextureUnits=ut,this.setTexture2D=dt,this.setTexture2DArray=gt,this.setTexture3D=Et,this.setTextureCube=St,this.rebindTextures=rn,this.setupRenderTarget=_n,this.updateRenderTargetMipmap=V,this.updateMultisampleRenderTarget=Zt,this.setupDepthRenderbuffer=wn,this.setupFrameBufferTexture=Ue,this.useMultisampledRTT=bt,this.dispose=z}function C1(i,t){function e(n,s=Fs){let r,o=xe.getTransfer(s);if(n===hi)return i.UNSIGNED_BYTE;if(n===$c)return i.UNSIGNED_SHORT_4_4_4_4;if(n===Kc)return i.UNSIGNED_SHORT_5_5_5_1;if(n===Sd)return i.UNSIGNED_INT_5_9_9_9_REV;if(n===Md)return i.UNSIGNED_INT_10F_11F_11F_REV;if(n===yd)return i.BYTE;if(n===vd)return i.SHORT;if(n===Uo)return i.UNSIGNED_SHORT;if(n===Zc)return i.INT;if(n===Hi)return i.UNSIGNED_INT;if(n===ui)return i.FLOAT;if(n===Wi)return i.HALF_FLOAT;if(n===bd)return i.ALPHA;if(n===wd)return i.RGB;if(n===Xi)return i.RGBA;if(n===Rs)return i.DEPTH_COMPONENT;if(n===Us)return i.DEPTH_STENCIL;if(n===Fo)return i.RED;if(n===Jc)return i.RED_INTEGER;if(n===rr)return i.RG;if(n===jc)return i.RG_INTEGER;if(n===Qc)return i.RGBA_INTEGER;if(n===rl||n===ol||n===al||n===ll)if(o===Re)if(r=t.get("WEBGL_compressed_texture_s3tc_srgb"),r!==null){if(n===rl)return r.COMPRESSED_SRGB_S3TC_DXT1_EXT;if(n===ol)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT;if(n===al)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT;if(n===ll)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT}else return null;else if(r=t.get("WEBGL_compressed_texture_s3tc"),r!==null){if(n===rl)return r.COMPRESSED_RGB_S3TC_DXT1_EXT;if(n===ol)return r.COMPRESSED_RGBA_S3TC_DXT1_EXT;if(n===al)return r.COMPRESSED_RGBA_S3TC_DXT3_EXT;if(n===ll)return r.COMPRESSED_RGBA_S3TC_DXT5_EXT}else return null;if(n===th||n===eh||n===nh||n===ih)if(r=t.get("WEBGL_compressed_texture_pvrtc"),r!==null){if(n===th)return r.COMPRESSED_RGB_PVRTC_4BPPV1_IMG;if(n===eh)return r.COMPRESSED_RGB_PVRTC_2BPPV1_IMG;if(n===nh)return r.COMPRESSED_RGBA_PVRTC_4BPPV1_IMG;if(n===ih)return r.COMPRESSED_RGBA_PVRTC_2BPPV1_IMG}else return null;if(n===sh||n===rh||n===oh||n===ah||n===lh||n===cl||n===ch)if(r=t.get("WEBGL_compressed_texture_etc"),r!==null){if(n===sh||n===rh)return o===Re?r.COMPRESSED_SRGB8_ETC2:r.COMPRESSED_RGB8_ETC2;if(n===oh)return o===Re?r.COMPRESSED_SRGB8_ALPHA8_ETC2_EAC:r.COMPRESSED_RGBA8_ETC2_EAC;if(n===ah)return r.COMPRESSED_R11_EAC;if(n===lh)return r.COMPRESSED_SIGNED_R11_EAC;if(n===cl)return r.COMPRESSED_RG11_EAC;if(n===ch)return r.COMPRESSED_SIGNED_RG11_EAC}else return null;if(n===hh||n===uh||n===fh||n===dh||n===ph||n===mh||n===gh||n===_h||n===xh||n===yh||n===vh||n===Sh||n===Mh||n===bh)if(r=t.get("WEBGL_compressed_texture_astc"),r!==null){if(n===hh)return o===Re?r.COMPRESSED_SRGB8_ALPHA8_ASTC_4x4_KHR:r.COMPRESSED_RGBA_ASTC_4x4_KHR;if(n===uh)return o===Re?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x4_KHR:r.COMPRESSED_RGBA_ASTC_5x4_KHR;if(n===fh)return o===Re?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x5_KHR:r.COMPRESSED_RGBA_ASTC_5x5_KHR;if(n===dh)return o===Re?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x5_KHR:r.COMPRESSED_RGBA_ASTC_6x5_KHR;if(n===ph)return o===Re?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x6_KHR:r.COMPRESSED_RGBA_ASTC_6x6_KHR;if(n===mh)return o===Re?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x5_KHR:r.COMPRESSED_RGBA_ASTC_8x5_KHR;if(n===gh)return o===Re?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x6_KHR:r.COMPRESSED_RGBA_ASTC_8x6_KHR;if(n===_h)return o===Re?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x8_KHR:r.COMPRESSED_RGBA_ASTC_8x8_KHR;if(n===xh)return o===Re?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x5_KHR:r.COMPRESSED_RGBA_ASTC_10x5_KHR;if(n===yh)return o===Re?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x6_KHR:r.COMPRESSED_RGBA_ASTC_10x6_KHR;if(n===vh)return o===Re?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x8_KHR:r.COMPRESSED_RGBA_ASTC_10x8_KHR;if(n===Sh)return o===Re?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x10_KHR:r.COMPRESSED_RGBA_ASTC_10x10_KHR;if(n===Mh)return o===Re?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x10_KHR:r.COMPRESSED_RGBA_ASTC_12x10_KHR;if(n===bh)return o===Re?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x12_KHR:r.COMPRESSED_RGBA_ASTC_12x12_KHR}else return null;if(n===wh||n===Th||n===Ah)if(r=t.get("EXT_texture_compression_bptc"),r!==null){if(n===wh)return o===Re?r.COMPRESSED_SRGB_ALPHA_BPTC_UNORM_EXT:r.COMPRESSED_RGBA_BPTC_UNORM_EXT;if(n===Th)return r.COMPRESSED_RGB_BPTC_SIGNED_FLOAT_EXT;if(n===Ah)return r.COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT_EXT}else return null;if(n===Eh||n===Ch||n===hl||n===Rh)if(r=t.get("EXT_texture_compression_rgtc"),r!==null){if(n===Eh)return r.COMPRESSED_RED_RGTC1_EXT;if(n===Ch)return r.COMPRESSED_SIGNED_RED_RGTC1_EXT;if(n===hl)return r.COMPRESSED_RED_GREEN_RGTC2_EXT;if(n===Rh)return r.COMPRESSED_SIGNED_RED_GREEN_RGTC2_EXT}else return null;return n===Pr?i.UNSIGNED_INT_24_8:i[n]!==void 0?i[n]:null}return{convert:e}}var R1=`
void main() {

	gl_Position = vec4( position, 1.0 );

}`,P1=`
uniform sampler2DArray depthColor;
uniform float depthWidth;
uniform float depthHeight;

void main() {

	vec2 coord = vec2( gl_FragCoord.x / depthWidth, gl_FragCoord.y / depthHeight );

	if ( coord.x >= 1.0 ) {

		gl_FragDepth = texture( depthColor, vec3( coord.x - 1.0, coord.y, 1 ) ).r;

	} else {

		gl_FragDepth = texture( depthColor, vec3( coord.x, coord.y, 0 ) ).r;

	}

}`,tp=class{constructor(){this.texture=null,this.mesh=null,this.depthNear=0,this.depthFar=0}init(t,e){if(this.texture===null){let n=new Xa(t.texture);(t.depthNear!==e.depthNear||t.depthFar!==e.depthFar)&&(this.depthNear=t.depthNear,this.depthFar=t.depthFar),this.texture=n}}getMesh(t){if(this.texture!==null&&this.mesh===null){let e=t.cameras[0].viewport,n=new ls({vertexShader:R1,fragmentShader:P1,uniforms:{depthColor:{value:this.texture},depthWidth:{value:e.z},depthHeight:{value:e.w}}});this.mesh=new En(new Ar(20,20),n)}return this.mesh}reset(){this.texture=null,this.mesh=null}getDepthTexture(){return this.texture}},ep=class extends Vi{constructor(t,e){super();let n=this,s=null,r=1,o=null,a="local-floor",l=1,c=null,f=null,u=null,h=null,d=null,g=null,v=typeof XRWebGLBinding<"u",m=new tp,p={},_=e.getContextAttributes(),M=null,y=null,w=[],T=[],x=new kt,b=null,D=null,C=new ii;C.viewport=new nn;let P=new ii;P.viewport=new nn;let I=[C,P],O=new Hc,L=null,z=null;this.cameraAutoUpdate=!0,this.enabled=!1,this.isPresenting=!1,this.getController=function(Q){let dt=w[Q];return dt===void 0&&(dt=new Ao,w[Q]=dt),dt.getTargetRaySpace()},this.getControllerGrip=function(Q){let dt=w[Q];return dt===void 0&&(dt=new Ao,w[Q]=dt),dt.getGripSpace()},this.getHand=function(Q){let dt=w[Q];return dt===void 0&&(dt=new Ao,w[Q]=dt),dt.getHandSpace()};function X(Q){let dt=T.indexOf(Q.inputSource);if(dt===-1)return;let gt=w[dt];gt!==void 0&&(gt.update(Q.inputSource,Q.frame,c||o),gt.dispatchEvent({type:Q.type,data:Q.inputSource}))}function H(){s.removeEventListener("select",X),s.removeEventListener("selectstart",X),s.removeEventListener("selectend",X),s.removeEventListener("squeeze",X),s.removeEventListener("squeezestart",X),s.removeEventListener("squeezeend",X),s.removeEventListener("end",H),s.removeEventListener("inputsourceschange",at);for(let Q=0;Q<w.length;Q++){let dt=T[Q];dt!==null&&(T[Q]=null,w[Q].disconnect(dt))}L=null,z=null,m.reset();for(let Q in p)delete p[Q];if(t.setRenderTarget(M),d=null,h=null,u=null,s=null,y=null,ht.stop(),n.isPresenting=!1,t.setPixelRatio(b),t.setSize(x.width,x.height,!1),D!==null){let Q=D.camera;Q.fov=D.fov,Q.zoom=D.zoom,Q.updateProjectionMatrix(),D=null}n.dispatchEvent({type:"sessionend"})}this.setFramebufferScaleFactor=function(Q){r=Q,n.isPresenting===!0&&Yt("WebXRManager: Cannot change framebuffer scale while presenting.")},this.setReferenceSpaceType=function(Q){a=Q,n.isPresenting===!0&&Yt("WebXRManager: Cannot change reference space type while presenting.")},this.getReferenceSpace=function(){return c||o},this.setReferenceSpace=function(Q){c=Q},this.getBaseLayer=function(){return h!==null?h:d},this.getBinding=function(){return u===null&&v&&(u=new XRWebGLBinding(s,e)),u},this.getFrame=function(){return g},this.getSession=function(){return s},this.setSession=async function(Q){if(s=Q,s!==null){if(M=t.getRenderTarget(),s.addEventListener("select",X),s.addEventListener("selectstart",X),s.addEventListener("selectend",X),s.addEventListener("squeeze",X),s.addEventListener("squeezestart",X),s.addEventListener("squeezeend",X),s.addEventListener("end",H),s.addEventListener("inputsourceschange",at),_.xrCompatible!==!0&&await e.makeXRCompatible(),b=t.getPixelRatio(),t.getSize(x),v&&"createProjectionLayer"in XRWebGLBinding.prototype){let gt=null,Et=null,St=null;_.depth&&(St=_.stencil?e.DEPTH24_STENCIL8:e.DEPTH_COMPONENT24,gt=_.stencil?Us:Rs,Et=_.stencil?Pr:Hi);let Ht={colorFormat:e.RGBA8,depthFormat:St,scaleFactor:r};u=this.getBinding(),h=u.createProjectionLayer(Ht),s.updateRenderState({layers:[h]}),t.setPixelRatio(1),t.setSize(h.textureWidth,h.textureHeight,!1),y=new vi(h.textureWidth,h.textureHeight,{format:Xi,type:hi,depthTexture:new Ds(h.textureWidth,h.textureHeight,Et,void 0,void 0,void 0,void 0,void 0,void 0,gt),stencilBuffer:_.stencil,colorSpace:t.outputColorSpace,samples:_.antialias?4:0,resolveDepthBuffer:h.ignoreDepthValues===!1,resolveStencilBuffer:h.ignoreDepthValues===!1,storeMultisampledDepthBuffer:h.ignoreDepthValues===!1,storeMultisampledStencilBuffer:h.ignoreDepthValues===!1})}else{let gt={antialias:_.antialias,alpha:!0,depth:_.depth,stencil:_.stencil,framebufferScaleFactor:r};d=new XRWebGLLayer(s,e,gt),s.updateRenderState({baseLayer:d}),t.setPixelRatio(1),t.setSize(d.framebufferWidth,d.framebufferHeight,!1),y=new vi(d.framebufferWidth,d.framebufferHeight,{format:Xi,type:hi,colorSpace:t.outputColorSpace,stencilBuffer:_.stencil,resolveDepthBuffer:d.ignoreDepthValues===!1,resolveStencilBuffer:d.ignoreDepthValues===!1,storeMultisampledDepthBuffer:d.ignoreDepthValues===!1,storeMultisampledStencilBuffer:d.ignoreDepthValues===!1})}y.isXRRenderTarget=!0,this.setFoveation(l),c=null,o=await s.requestReferenceSpace(a),ht.setContext(s),ht.start(),n.isPresenting=!0,n.dispatchEvent({type:"sessionstart"})}},this.getEnvironmentBlendMode=function(){if(s!==null)return s.environmentBlendMode},this.getDepthTexture=function(){return m.getDepthTexture()};function at(Q){for(let dt=0;dt<Q.removed.length;dt++){let gt=Q.removed[dt],Et=T.indexOf(gt);Et>=0&&(T[Et]=null,w[Et].disconnect(gt))}for(let dt=0;dt<Q.added.length;dt++){let gt=Q.added[dt],Et=T.indexOf(gt);if(Et===-1){for(let Ht=0;Ht<w.length;Ht++)if(Ht>=T.length){T.push(gt),Et=Ht;break}else if(T[Ht]===null){T[Ht]=gt,Et=Ht;break}if(Et===-1)break}let St=w[Et];St&&St.connect(gt)}}function Z(Q,dt){dt===null?Q.matrixWorld.copy(Q.matrix):Q.matrixWorld.multiplyMatrices(dt.matrixWorld,Q.matrix),Q.matrixWorldInverse.copy(Q.matrixWorld).invert()}this.updateCamera=function(Q){if(s===null)return;let dt=Q.near,gt=Q.far;m.texture!==null&&(m.depthNear>0&&(dt=m.depthNear),m.depthFar>0&&(gt=m.depthFar)),O.near=P.near=C.near=dt,O.far=P.far=C.far=gt,(L!==O.near||z!==O.far)&&(s.updateRenderState({depthNear:O.near,depthFar:O.far}),L=O.near,z=O.far),O.layers.mask=Q.layers.mask|6,C.layers.mask=O.layers.mask&-5,P.layers.mask=O.layers.mask&-3;let Et=Q.parent,St=O.cameras;Z(O,Et);for(let Ht=0;Ht<St.length;Ht++)Z(St[Ht],Et);O.projectionMatrix.copy(C.projectionMatrix),O.projectionMatrixInverse.copy(C.projectionMatrixInverse),D===null&&Q.isPerspectiveCamera&&(D={camera:Q,fov:Q.fov,zoom:Q.zoom}),j(Q,O,Et)};function j(Q,dt,gt){gt===null?Q.matrix.copy(dt.matrixWorld):(Q.matrix.copy(gt.matrixWorld),Q.matrix.invert(),Q.matrix.multiply(dt.matrixWorld)),Q.matrix.decompose(Q.position,Q.quaternion,Q.scale),Q.updateMatrixWorld(!0),Q.projectionMatrix.copy(dt.projectionMatrix),Q.projectionMatrixInverse.copy(dt.projectionMatrixInverse),Q.isPerspectiveCamera&&(Q.fov=bo*2*Math.atan(1/Q.projectionMatrix.elements[5]),Q.zoom=1)}this.getCamera=function(){return O},this.getFoveation=function(){if(!(h===null&&d===null))return l},this.setFoveation=function(Q){l=Q,h!==null&&(h.fixedFoveation=Q),d!==null&&d.fixedFoveation!==void 0&&(d.fixedFoveation=Q)},this.hasDepthSensing=function(){return m.texture!==null},this.getDepthSensingMesh=function(){return m.getMesh(O)},this.getCameraTexture=function(Q){return p[Q]};let nt=null;function ut(Q,dt){if(f=dt.getViewerPose(c||o),g=dt,f!==null){let gt=f.views;d!==null&&(t.setRenderTargetFramebuffer(y,d.framebuffer),t.setRenderTarget(y));let Et=!1;gt.length!==O.cameras.length&&(O.cameras.length=0,Et=!0);for(let Vt=0;Vt<gt.length;Vt++){let le=gt[Vt],he=null;if(d!==null)he=d.getViewport(le);else{let Qe=u.getViewSubImage(h,le);he=Qe.viewport,Vt===0&&(t.setRenderTargetTextures(y,Qe.colorTexture,Qe.depthStencilTexture),t.setRenderTarget(y))}let se=I[Vt];se===void 0&&(se=new ii,se.layers.enable(Vt),se.viewport=new nn,I[Vt]=se),se.matrix.fromArray(le.transform.matrix),se.matrix.decompose(se.position,se.quaternion,se.scale),se.projectionMatrix.fromArray(le.projectionMatrix),se.projectionMatrixInverse.copy(se.projectionMatrix).invert(),se.viewport.set(he.x,he.y,he.width,he.height),Vt===0&&(O.matrix.copy(se.matrix),O.matrix.decompose(O.position,O.quaternion,O.scale)),Et===!0&&O.cameras.push(se)}let St=s.enabledFeatures;if(St&&St.includes("depth-sensing")&&s.depthUsage=="gpu-optimized"&&v){u=n.getBinding();let Vt=u.getDepthInformation(gt[0]);Vt&&Vt.isValid&&Vt.texture&&m.init(Vt,s.renderState)}if(St&&St.includes("camera-access")&&v){t.state.unbindTexture(),u=n.getBinding();for(let Vt=0;Vt<gt.length;Vt++){let le=gt[Vt].camera;if(le){let he=p[le];he||(he=new Xa,p[le]=he);let se=u.getCameraImage(le);he.sourceTexture=se}}}}for(let gt=0;gt<w.length;gt++){let Et=T[gt],St=w[gt];Et!==null&&St!==void 0&&St.update(Et,dt,c||o)}nt&&nt(Q,dt),dt.detectedPlanes&&n.dispatchEvent({type:"planesdetected",data:dt}),g=null}let ht=new I0;ht.setAnimationLoop(ut),this.setAnimationLoop=function(Q){nt=Q},this.dispose=function(){}}},I1=new te,V0=new ie;V0.set(-1,0,0,0,1,0,0,0,1);function L1(i,t){function e(m,p){m.matrixAutoUpdate===!0&&m.updateMatrix(),p.value.copy(m.matrix)}function n(m,p){p.color.getRGB(m.fogColor.value,Od(i)),p.isFog?(m.fogNear.value=p.near,m.fogFar.value=p.far):p.isFogExp2&&(m.fogDensity.value=p.density)}function s(m,p,_,M,y){p.isNodeMaterial?p.uniformsNeedUpdate=!1:p.isMeshBasicMaterial?r(m,p):p.isMeshLambertMaterial?(r(m,p),p.envMap&&(m.envMapIntensity.value=p.envMapIntensity)):p.isMeshToonMaterial?(r(m,p),u(m,p)):p.isMeshPhongMaterial?(r(m,p),f(m,p),p.envMap&&(m.envMapIntensity.value=p.envMapIntensity)):p.isMeshStandardMaterial?(r(m,p),h(m,p),p.isMeshPhysicalMaterial&&d(m,p,y)):p.isMeshMatcapMaterial?(r(m,p),g(m,p)):p.isMeshDepthMaterial?r(m,p):p.isMeshDistanceMaterial?(r(m,p),v(m,p)):p.isMeshNormalMaterial?r(m,p):p.isLineBasicMaterial?(o(m,p),p.isLineDashedMaterial&&a(m,p)):p.isPointsMaterial?l(m,p,_,M):p.isSpriteMaterial?c(m,p):p.isShadowMaterial?(m.color.value.copy(p.color),m.opacity.value=p.opacity):p.isShaderMaterial&&(p.uniformsNeedUpdate=!1)}function r(m,p){m.opacity.value=p.opacity,p.color&&m.diffuse.value.copy(p.color),p.emissive&&m.emissive.value.copy(p.emissive).multiplyScalar(p.emissiveIntensity),p.map&&(m.map.value=p.map,e(p.map,m.mapTransform)),p.alphaMap&&(m.alphaMap.value=p.alphaMap,e(p.alphaMap,m.alphaMapTransform)),p.bumpMap&&(m.bumpMap.value=p.bumpMap,e(p.bumpMap,m.bumpMapTransform),m.bumpScale.value=p.bumpScale,p.side===Cn&&(m.bumpScale.value*=-1)),p.normalMap&&(m.normalMap.value=p.normalMap,e(p.normalMap,m.normalMapTransform),m.normalScale.value.copy(p.normalScale),p.side===Cn&&m.normalScale.value.negate()),p.displacementMap&&(m.displacementMap.value=p.displacementMap,e(p.displacementMap,m.displacementMapTransform),m.displacementScale.value=p.displacementScale,m.displacementBias.value=p.displacementBias),p.emissiveMap&&(m.emissiveMap.value=p.emissiveMap,e(p.emissiveMap,m.emissiveMapTransform)),p.specularMap&&(m.specularMap.value=p.specularMap,e(p.specularMap,m.specularMapTransform)),p.alphaTest>0&&(m.alphaTest.value=p.alphaTest);let _=t.get(p),M=_.envMap,y=_.envMapRotation;M&&(m.envMap.value=M,m.envMapRotation.value.setFromMatrix4(I1.makeRotationFromEuler(y)).transpose(),M.isCubeTexture&&M.isRenderTargetTexture===!1&&m.envMapRotation.value.premultiply(V0),m.reflectivity.value=p.reflectivity,m.ior.value=p.ior,m.refractionRatio.value=p.refractionRatio),p.lightMap&&(m.lightMap.value=p.lightMap,m.lightMapIntensity.value=p.lightMapIntensity,e(p.lightMap,m.lightMapTransform)),p.aoMap&&(m.aoMap.value=p.aoMap,m.aoMapIntensity.value=p.aoMapIntensity,e(p.aoMap,m.aoMapTransform))}function o(m,p){m.diffuse.value.copy(p.color),m.opacity.value=p.opacity,p.map&&(m.map.value=p.map,e(p.map,m.mapTransform))}function a(m,p){m.dashSize.value=p.dashSize,m.totalSize.value=p.dashSize+p.gapSize,m.scale.value=p.scale}function l(m,p,_,M){m.diffuse.value.copy(p.color),m.opacity.value=p.opacity,m.size.value=p.size*_,m.scale.value=M*.5,p.map&&(m.map.value=p.map,e(p.map,m.uvTransform)),p.alphaMap&&(m.alphaMap.value=p.alphaMap,e(p.alphaMap,m.alphaMapTransform)),p.alphaTest>0&&(m.alphaTest.value=p.alphaTest)}function c(m,p){m.diffuse.value.copy(p.color),m.opacity.value=p.opacity,m.rotation.value=p.rotation,p.map&&(m.map.value=p.map,e(p.map,m.mapTransform)),p.alphaMap&&(m.alphaMap.value=p.alphaMap,e(p.alphaMap,m.alphaMapTransform)),p.alphaTest>0&&(m.alphaTest.value=p.alphaTest)}function f(m,p){m.specular.value.copy(p.specular),m.shininess.value=Math.max(p.shininess,1e-4)}function u(m,p){p.gradientMap&&(m.gradientMap.value=p.gradientMap)}function h(m,p){m.metalness.value=p.metalness,p.metalnessMap&&(m.metalnessMap.value=p.metalnessMap,e(p.metalnessMap,m.metalnessMapTransform)),m.roughness.value=p.roughness,p.roughnessMap&&(m.roughnessMap.value=p.roughnessMap,e(p.roughnessMap,m.roughnessMapTransform)),p.envMap&&(m.envMapIntensity.value=p.envMapIntensity)}function d(m,p,_){m.ior.value=p.ior,p.diffuseRoughness>0&&(m.diffuseRoughness.value=p.diffuseRoughness,p.diffuseRoughnessMap&&(m.diffuseRoughnessMap.value=p.diffuseRoughnessMap,e(p.diffuseRoughnessMap,m.diffuseRoughnessMapTransform))),p.sheen>0&&(m.sheenColor.value.copy(p.sheenColor).multiplyScalar(p.sheen),m.sheenRoughness.value=p.sheenRoughness,p.sheenColorMap&&(m.sheenColorMap.value=p.sheenColorMap,e(p.sheenColorMap,m.sheenColorMapTransform)),p.sheenRoughnessMap&&(m.sheenRoughnessMap.value=p.sheenRoughnessMap,e(p.sheenRoughnessMap,m.sheenRoughnessMapTransform))),p.clearcoat>0&&(m.clearcoat.value=p.clearcoat,m.clearcoatRoughness.value=p.clearcoatRoughness,p.clearcoatMap&&(m.clearcoatMap.value=p.clearcoatMap,e(p.clearcoatMap,m.clearcoatMapTransform)),p.clearcoatRoughnessMap&&(m.clearcoatRoughnessMap.value=p.clearcoatRoughnessMap,e(p.clearcoatRoughnessMap,m.clearcoatRoughnessMapTransform)),p.clearcoatNormalMap&&(m.clearcoatNormalMap.value=p.clearcoatNormalMap,e(p.clearcoatNormalMap,m.clearcoatNormalMapTransform),m.clearcoatNormalScale.value.copy(p.clearcoatNormalScale),p.side===Cn&&m.clearcoatNormalScale.value.negate())),p.dispersion>0&&(m.dispersion.value=p.dispersion),p.retroreflectivity>0&&(m.retroreflectivity.value=p.retroreflectivity),p.iridescence>0&&(m.iridescence.value=p.iridescence,m.iridescenceIOR.value=p.iridescenceIOR,m.iridescenceThicknessMinimum.value=p.iridescenceThicknessMinimum,m.iridescenceThicknessMaximum.value=p.iridescenceThicknessMaximum,p.iridescenceMap&&(m.iridescenceMap.value=p.iridescenceMap,e(p.iridescenceMap,m.iridescenceMapTransform)),p.iridescenceThicknessMap&&(m.iridescenceThicknessMap.value=p.iridescenceThicknessMap,e(p.iridescenceThicknessMap,m.iridescenceThicknessMapTransform))),p.transmission>0&&(m.transmission.value=p.transmission,m.transmissionSamplerMap.value=_.texture,m.transmissionSamplerSize.value.set(_.width,_.height),p.transmissionMap&&(m.transmissionMap.value=p.transmissionMap,e(p.transmissionMap,m.transmissionMapTransform)),m.thickness.value=p.thickness,p.thicknessMap&&(m.thicknessMap.value=p.thicknessMap,e(p.thicknessMap,m.thicknessMapTransform)),m.attenuationDistance.value=p.attenuationDistance,m.attenuationColor.value.copy(p.attenuationColor)),p.anisotropy>0&&(m.anisotropyVector.value.set(p.anisotropy*Math.cos(p.anisotropyRotation),p.anisotropy*Math.sin(p.anisotropyRotation)),p.anisotropyMap&&(m.anisotropyMap.value=p.anisotropyMap,e(p.anisotropyMap,m.anisotropyMapTransform))),m.specularIntensity.value=p.specularIntensity,m.specularColor.value.copy(p.specularColor),p.specularColorMap&&(m.specularColorMap.value=p.specularColorMap,e(p.specularColorMap,m.specularColorMapTransform)),p.specularIntensityMap&&(m.specularIntensityMap.value=p.specularIntensityMap,e(p.specularIntensityMap,m.specularIntensityMapTransform))}function g(m,p){p.matcap&&(m.matcap.value=p.matcap)}function v(m,p){let _=t.get(p).light;m.referencePosition.value.setFromMatrixPosition(_.matrixWorld),m.nearDistance.value=_.shadow.camera.near,m.farDistance.value=_.shadow.camera.far}return{refreshFogUniforms:n,refreshMaterialUniforms:s}}function D1(i,t,e,n){let s={},r={};function o(_,M){let y=M.program;n.uniformBlockBinding(_,y,s[_.id])}function a(_,M){let y=s[_.id];y===void 0&&(g(_),y=l(_),s[_.id]=y,_.addEventListener("dispose",m));let w=M.program;n.updateUBOMapping(_,w);let T=t.render.frame;r[_.id]!==T&&(c(_),r[_.id]=T)}function l(_){let M=i.createBuffer(),y=_.__size,w=_.usage;return i.bindBuffer(i.UNIFORM_BUFFER,M),i.bufferData(i.UNIFORM_BUFFER,y,w),i.bindBuffer(i.UNIFORM_BUFFER,null),M}function c(_){let M=s[_.id],y=_.uniforms,w=_.__cache;i.bindBuffer(i.UNIFORM_BUFFER,M);for(let T=0,x=y.length;T<x;T++){let b=y[T];if(Array.isArray(b))for(let D=0,C=b.length;D<C;D++)f(b[D],T,D,w);else f(b,T,0,w)}i.bindBuffer(i.UNIFORM_BUFFER,null)}function f(_,M,y,w){if(h(_,M,y,w)===!0){let T=_.__offset,x=_.value;if(Array.isArray(x)){let b=0;for(let D=0;D<x.length;D++){let C=x[D],P=v(C,!0);u(C,_.__data,b),b+=P.storage/Float32Array.BYTES_PER_ELEMENT}}else u(x,_.__data,0);i.bufferSubData(i.UNIFORM_BUFFER,T,_.__data)}}function u(_,M,y){typeof _=="number"||typeof _=="boolean"?M[y]=_:_.isMatrix3?(M[y]=_.elements[0],M[y+1]=_.elements[1],M[y+2]=_.elements[2],M[y+3]=0,M[y+4]=_.elements[3],M[y+5]=_.elements[4],M[y+6]=_.elements[5],M[y+7]=0,M[y+8]=_.elements[6],M[y+9]=_.elements[7],M[y+10]=_.elements[8],M[y+11]=0):ArrayBuffer.isView(_)?M.set(_.subarray(0,M.length-y),y):_.toArray(M,y)}function h(_,M,y,w){let T=_.value,x=M+"_"+y;if(Array.isArray(T)){w[x]===void 0&&(w[x]=[]);let b=w[x],D=!1;for(let C=0;C<T.length;C++)d(T[C],b,C)===!0&&(D=!0);return D}return d(T,w,x)}function d(_,M,y){if(M[y]===void 0)return typeof _=="number"||typeof _=="boolean"?M[y]=_:ArrayBuffer.isView(_)?M[y]=_.slice():M[y]=_.clone(),!0;{let w=M[y];if(typeof _=="number"||typeof _=="boolean"){if(w!==_)return M[y]=_,!0}else{if(ArrayBuffer.isView(_))return!0;if(w.equals(_)===!1)return w.copy(_),!0}}return!1}function g(_){let M=_.uniforms,y=0,w=16;for(let x=0,b=M.length;x<b;x++){let D=Array.isArray(M[x])?M[x]:[M[x]];for(let C=0,P=D.length;C<P;C++){let I=D[C],O=Array.isArray(I.value)?I.value:[I.value],L=Array.isArray(M[x])||Array.isArray(I.value),z=y;for(let H=0,at=O.length;H<at;H++){let Z=O[H],j=v(Z,L),nt=y%w,ut=nt%j.boundary,ht=nt+ut;y+=ut,ht!==0&&w-ht<j.storage&&(y+=w-ht),H===0&&(z=y),y+=j.storage}let X=I.type==="int"?Int32Array:I.type==="uint"?Uint32Array:Float32Array;I.__data=new X((y-z)/Float32Array.BYTES_PER_ELEMENT),I.__offset=z}}let T=y%w;return T>0&&(y+=w-T),_.__size=y,_.__cache={},this}function v(_,M){let y={boundary:0,storage:0};return typeof _=="number"||typeof _=="boolean"?(y.boundary=4,y.storage=4):_.isVector2?(y.boundary=8,y.storage=8):_.isVector3||_.isColor?(y.boundary=16,y.storage=12):_.isVector4?(y.boundary=16,y.storage=16):_.isMatrix3?(y.boundary=16,y.storage=48):_.isMatrix4?(y.boundary=16,y.storage=64):_.isTexture?Yt("WebGLRenderer: Texture samplers can not be part of an uniforms group."):ArrayBuffer.isView(_)?(y.boundary=16,y.storage=_.byteLength):Yt("WebGLRenderer: Unsupported uniform value type.",_),M===!0&&(y.boundary=16,y.storage=Math.ceil(y.storage/16)*16),y}function m(_){let M=_.target;M.removeEventListener("dispose",m),i.deleteBuffer(s[M.id]),delete s[M.id],delete r[M.id]}function p(){for(let _ in s)i.deleteBuffer(s[_]);s={},r={}}return{bind:o,update:a,dispose:p}}var N1=new Uint16Array([12469,15057,12620,14925,13266,14620,13807,14376,14323,13990,14545,13625,14713,13328,14840,12882,14931,12528,14996,12233,15039,11829,15066,11525,15080,11295,15085,10976,15082,10705,15073,10495,13880,14564,13898,14542,13977,14430,14158,14124,14393,13732,14556,13410,14702,12996,14814,12596,14891,12291,14937,11834,14957,11489,14958,11194,14943,10803,14921,10506,14893,10278,14858,9960,14484,14039,14487,14025,14499,13941,14524,13740,14574,13468,14654,13106,14743,12678,14818,12344,14867,11893,14889,11509,14893,11180,14881,10751,14852,10428,14812,10128,14765,9754,14712,9466,14764,13480,14764,13475,14766,13440,14766,13347,14769,13070,14786,12713,14816,12387,14844,11957,14860,11549,14868,11215,14855,10751,14825,10403,14782,10044,14729,9651,14666,9352,14599,9029,14967,12835,14966,12831,14963,12804,14954,12723,14936,12564,14917,12347,14900,11958,14886,11569,14878,11247,14859,10765,14828,10401,14784,10011,14727,9600,14660,9289,14586,8893,14508,8533,15111,12234,15110,12234,15104,12216,15092,12156,15067,12010,15028,11776,14981,11500,14942,11205,14902,10752,14861,10393,14812,9991,14752,9570,14682,9252,14603,8808,14519,8445,14431,8145,15209,11449,15208,11451,15202,11451,15190,11438,15163,11384,15117,11274,15055,10979,14994,10648,14932,10343,14871,9936,14803,9532,14729,9218,14645,8742,14556,8381,14461,8020,14365,7603,15273,10603,15272,10607,15267,10619,15256,10631,15231,10614,15182,10535,15118,10389,15042,10167,14963,9787,14883,9447,14800,9115,14710,8665,14615,8318,14514,7911,14411,7507,14279,7198,15314,9675,15313,9683,15309,9712,15298,9759,15277,9797,15229,9773,15166,9668,15084,9487,14995,9274,14898,8910,14800,8539,14697,8234,14590,7790,14479,7409,14367,7067,14178,6621,15337,8619,15337,8631,15333,8677,15325,8769,15305,8871,15264,8940,15202,8909,15119,8775,15022,8565,14916,8328,14804,8009,14688,7614,14569,7287,14448,6888,14321,6483,14088,6171,15350,7402,15350,7419,15347,7480,15340,7613,15322,7804,15287,7973,15229,8057,15148,8012,15046,7846,14933,7611,14810,7357,14682,7069,14552,6656,14421,6316,14251,5948,14007,5528,15356,5942,15356,5977,15353,6119,15348,6294,15332,6551,15302,6824,15249,7044,15171,7122,15070,7050,14949,6861,14818,6611,14679,6349,14538,6067,14398,5651,14189,5311,13935,4958,15359,4123,15359,4153,15356,4296,15353,4646,15338,5160,15311,5508,15263,5829,15188,6042,15088,6094,14966,6001,14826,5796,14678,5543,14527,5287,14377,4985,14133,4586,13869,4257,15360,1563,15360,1642,15358,2076,15354,2636,15341,3350,15317,4019,15273,4429,15203,4732,15105,4911,14981,4932,14836,4818,14679,4621,14517,4386,14359,4156,14083,3795,13808,3437,15360,122,15360,137,15358,285,15355,636,15344,1274,15322,2177,15281,2765,15215,3223,15120,3451,14995,3569,14846,3567,14681,3466,14511,3305,14344,3121,14037,2800,13753,2467,15360,0,15360,1,15359,21,15355,89,15346,253,15325,479,15287,796,15225,1148,15133,1492,15008,1749,14856,1882,14685,1886,14506,1783,14324,1608,13996,1398,13702,1183]),us=null;function U1(){return us===null&&(us=new wr(N1,16,16,rr,Wi),us.name="DFG_LUT",us.minFilter=si,us.magFilter=si,us.wrapS=rs,us.wrapT=rs,us.generateMipmaps=!1,us.needsUpdate=!0),us}var Uh=class{constructor(t={}){let{canvas:e=t0(),context:n=null,depth:s=!0,stencil:r=!1,alpha:o=!1,antialias:a=!1,premultipliedAlpha:l=!0,preserveDrawingBuffer:c=!1,powerPreference:f="default",failIfMajorPerformanceCaveat:u=!1,reversedDepthBuffer:h=!1,outputBufferType:d=hi}=t;this.isWebGLRenderer=!0;let g;if(n!==null){if(typeof WebGLRenderingContext<"u"&&n instanceof WebGLRenderingContext)throw new Error("THREE.WebGLRenderer: WebGL 1 is not supported since r163.");g=n.getContextAttributes().alpha}else g=o;let v=d,m=new Set([Qc,jc,Jc]),p=new Set([hi,Hi,Uo,Pr,$c,Kc]),_=new Uint32Array(4),M=new Int32Array(4),y={textures:[],min:[],max:[],resolution:[]},w=null,T=null,x=[],b=[],D=null;this.domElement=e,this.debug={checkShaderErrors:!0,diagnostics:{keywords:!1},onShaderError:null},this.autoClear=!0,this.autoClearColor=!0,this.autoClearDepth=!0,this.autoClearStencil=!0,this.sortObjects=!0,this.clippingPlanes=[],this.localClippingEnabled=!1,this.toneMapping=hs,this.toneMappingExposure=1,this.transmissionResolutionScale=1;let C=this,P=!1,I=null,O=null,L=null,z=null;this._outputColorSpace=yi;let X=0,H=0,at=null,Z=-1,j=null,nt=new nn,ut=new nn,ht=null,Q=new $t(0),dt=0,gt=e.width,Et=e.height,St=1,Ht=null,ne=null,Vt=new nn(0,0,gt,Et),le=new nn(0,0,gt,Et),he=!1,se=new js,Qe=new Ac,We=!1,gn=!1,Ue=new te,Nn=new U,ve=new nn,wn={background:null,fog:null,environment:null,overrideMaterial:null,isScene:!0},rn=!1;function _n(){return at===null?St:1}let V=n;function Rt(R,G){return e.getContext(R,G)}let Zt,oe,bt,ze,Gt,qt,N,A,q,ct,rt,xt,yt,tt,it,pt,k,st,et,wt,_t,Mt,Wt;try{let R={alpha:!0,depth:s,stencil:r,antialias:a,premultipliedAlpha:l,preserveDrawingBuffer:c,powerPreference:f,failIfMajorPerformanceCaveat:u};if("setAttribute"in e&&e.setAttribute("data-engine",`three.js r${"187"}`),e.addEventListener("webglcontextlost",Ot,!1),e.addEventListener("webglcontextrestored",jt,!1),e.addEventListener("webglcontextcreationerror",Ct,!1),V===null){let G="webgl2";if(V=Rt(G,R),V===null)throw Rt(G)?new Error("THREE.WebGLRenderer: Error creating WebGL context with your selected attributes."):new Error("THREE.WebGLRenderer: Error creating WebGL context.")}Jt()}catch(R){throw e.removeEventListener("webglcontextlost",Ot,!1),e.removeEventListener("webglcontextrestored",jt,!1),e.removeEventListener("webglcontextcreationerror",Ct,!1),Qt("WebGLRenderer: "+R.message),R}function Jt(){Zt=new qb(V),Zt.init(),_t=new C1(V,Zt),oe=new Ub(V,Zt,t,_t),bt=new A1(V,Zt),oe.reversedDepthBuffer&&h&&bt.buffers.depth.setReversed(!0),O=V.createFramebuffer(),L=V.createFramebuffer(),z=V.createFramebuffer(),ze=new $b(V),Gt=new f1,qt=new E1(V,Zt,bt,Gt,oe,_t,ze),N=new Xb(C),A=new Jv(V),Mt=new Db(V,A),q=new Yb(V,A,ze,Mt),ct=new Jb(V,q,A,Mt,ze),st=new Kb(V,oe,qt),it=new Fb(Gt),rt=new u1(C,N,Zt,oe,Mt,it),xt=new L1(C,Gt),yt=new p1,tt=new v1(Zt),k=new Lb(C,N,bt,ct,g,l),pt=new T1(C,ct,oe),Wt=new D1(V,ze,oe,bt),et=new Nb(V,Zt,ze),wt=new Zb(V,Zt,ze),ze.programs=rt.programs,C.capabilities=oe,C.extensions=Zt,C.properties=Gt,C.renderLists=yt,C.shadowMap=pt,C.state=bt,C.info=ze}v!==hi&&(D=new Qb(v,e.width,e.height,a,s,r));let lt=new ep(C,V);this.xr=lt,this.getContext=function(){return V},this.getContextAttributes=function(){return V.getContextAttributes()},this.forceContextLoss=function(){let R=Zt.get("WEBGL_lose_context");R&&R.loseContext()},this.forceContextRestore=function(){let R=Zt.get("WEBGL_lose_context");R&&R.restoreContext()},this.getPixelRatio=function(){return St},this.setPixelRatio=function(R){R!==void 0&&(St=R,this.setSize(gt,Et,!1))},this.getSize=function(R){return R.set(gt,Et)},this.setSize=function(R,G,J=!0){if(lt.isPresenting){Yt("WebGLRenderer: Can't change size while VR device is presenting.");return}gt=R,Et=G,e.width=Math.floor(R*St),e.height=Math.floor(G*St),J===!0&&(e.style.width=R+"px",e.style.height=G+"px"),D!==null&&D.setSize(e.width,e.height),this.setViewport(0,0,R,G)},this.getDrawingBufferSize=function(R){return R.set(gt*St,Et*St).floor()},this.setDrawingBufferSize=function(R,G,J){gt=R,Et=G,St=J,e.width=Math.floor(R*J),e.height=Math.floor(G*J),this.setViewport(0,0,R,G)},this.setEffects=function(R){if(v===hi){Qt("WebGLRenderer: setEffects() requires outputBufferType set to HalfFloatType or FloatType.");return}if(R){for(let G=0;G<R.length;G++)if(R[G].isOutputPass===!0){Yt("WebGLRenderer: OutputPass is not needed in setEffects(). Tone mapping and color space conversion are applied automatically.");break}}D.setEffects(R||[])},this.getCurrentViewport=function(R){return R.copy(nt)},this.getViewport=function(R){return R.copy(Vt)},this.setViewport=function(R,G,J,Y){R.isVector4?Vt.set(R.x,R.y,R.z,R.w):Vt.set(R,G,J,Y),bt.viewport(nt.copy(Vt).multiplyScalar(_n()).round())},this.getScissor=function(R){return R.copy(le)},this.setScissor=function(R,G,J,Y){R.isVector4?le.set(R.x,R.y,R.z,R.w):le.set(R,G,J,Y),bt.scissor(ut.copy(le).multiplyScalar(_n()).round())},this.getScissorTest=function(){return he},this.setScissorTest=function(R){bt.setScissorTest(he=R)},this.setOpaqueSort=function(R){Ht=R},this.setTransparentSort=function(R){ne=R},this.getClearColor=function(R){return R.copy(k.getClearColor())},this.setClearColor=function(){k.setClearColor(...arguments)},this.getClearAlpha=function(){return k.getClearAlpha()},this.setClearAlpha=function(){k.setClearAlpha(...arguments)},this.clear=function(R=!0,G=!0,J=!0){let Y=0;if(R){let $=!1;if(at!==null){let Tt=at.texture.format;$=m.has(Tt)}if($){let Tt=at.texture.type,Pt=p.has(Tt),At=k.getClearColor(),It=k.getClearAlpha(),zt=At.r,ee=At.g,de=At.b;Pt?(_[0]=zt,_[1]=ee,_[2]=de,_[3]=It,V.clearBufferuiv(V.COLOR,0,_)):(M[0]=zt,M[1]=ee,M[2]=de,M[3]=It,V.clearBufferiv(V.COLOR,0,M))}else Y|=V.COLOR_BUFFER_BIT}G&&(Y|=V.DEPTH_BUFFER_BIT,this.state.buffers.depth.setMask(!0)),J&&(Y|=V.STENCIL_BUFFER_BIT,this.state.buffers.stencil.setMask(4294967295)),Y!==0&&V.clear(Y)},this.clearColor=function(){this.clear(!0,!1,!1)},this.clearDepth=function(){this.clear(!1,!0,!1)},this.clearStencil=function(){this.clear(!1,!1,!0)},this.setNodesHandler=function(R){R.setRenderer(this),I=R},this.dispose=function(){e.removeEventListener("webglcontextlost",Ot,!1),e.removeEventListener("webglcontextrestored",jt,!1),e.removeEventListener("webglcontextcreationerror",Ct,!1),k.dispose(),yt.dispose(),tt.dispose(),qt.dispose(),Gt.dispose(),N.dispose(),ct.dispose(),q.dispose(),Mt.dispose(),Wt.dispose(),rt.dispose(),lt.dispose(),lt.removeEventListener("sessionstart",Bl),lt.removeEventListener("sessionend",Ji),xs.stop()};function Ot(R){R.preventDefault(),Ld("WebGLRenderer: Context Lost."),P=!0}function jt(){Ld("WebGLRenderer: Context Restored."),P=!1;let R=ze.autoReset,G=pt.enabled,J=pt.autoUpdate,Y=pt.needsUpdate,$=pt.type;Jt(),ze.autoReset=R,pt.enabled=G,pt.autoUpdate=J,pt.needsUpdate=Y,pt.type=$}function Ct(R){Qt("WebGLRenderer: A WebGL context could not be created. Reason: ",R.statusMessage)}function ce(R){let G=R.target;G.removeEventListener("dispose",ce),qe(G)}function qe(R){jn(R),Gt.remove(R)}function jn(R){let G=Gt.get(R).programs;G!==void 0&&(G.forEach(function(J){rt.releaseProgram(J)}),R.isShaderMaterial&&rt.releaseShaderCache(R))}this.renderBufferDirect=function(R,G,J,Y,$,Tt){G===null&&(G=wn);let Pt=$.isMesh&&$.matrixWorld.determinantAffine()<0,At=xa(R,G,J,Y,$);bt.setMaterial(Y,Pt);let It=J.index,zt=1;if(Y.wireframe===!0){if(It=q.getWireframeAttribute(J),It===void 0)return;zt=2}let ee=J.drawRange,de=J.attributes.position,Bt=ee.start*zt,pe=(ee.start+ee.count)*zt;Tt!==null&&(Bt=Math.max(Bt,Tt.start*zt),pe=Math.min(pe,(Tt.start+Tt.count)*zt)),It!==null?(Bt=Math.max(Bt,0),pe=Math.min(pe,It.count)):de!=null&&(Bt=Math.max(Bt,0),pe=Math.min(pe,de.count));let sn=pe-Bt;if(sn<0||sn===1/0)return;Mt.setup($,Y,At,J,It);let Le,De=et;if(It!==null&&(Le=A.get(It),De=wt,De.setIndex(Le)),$.isMesh)Y.wireframe===!0?(bt.setLineWidth(Y.wireframeLinewidth*_n()),De.setMode(V.LINES)):De.setMode(V.TRIANGLES);else if($.isLine){let Tn=Y.linewidth;Tn===void 0&&(Tn=1),bt.setLineWidth(Tn*_n()),$.isLineSegments?De.setMode(V.LINES):$.isLineLoop?De.setMode(V.LINE_LOOP):De.setMode(V.LINE_STRIP)}else $.isPoints?De.setMode(V.POINTS):$.isSprite&&De.setMode(V.TRIANGLES);if($.isBatchedMesh)if(Zt.get("WEBGL_multi_draw"))De.renderMultiDraw($._multiDrawStarts,$._multiDrawCounts,$._multiDrawCount);else{let Tn=$._multiDrawStarts,Ut=$._multiDrawCounts,xn=$._multiDrawCount,_e=It?A.get(It).bytesPerElement:1,vs=Gt.get(Y).currentProgram.getUniforms();for(let yn=0;yn<xn;yn++)vs.setValue(V,"_gl_DrawID",yn),De.render(Tn[yn]/_e,Ut[yn])}else if($.isInstancedMesh)De.renderInstances(Bt,sn,$.count);else if(J.isInstancedBufferGeometry){let Tn=J._maxInstanceCount!==void 0?J._maxInstanceCount:1/0,Ut=Math.min(J.instanceCount,Tn);De.renderInstances(Bt,sn,Ut)}else De.render(Bt,sn)};function ma(R,G,J,Y){I!==null&&R.isNodeMaterial&&I.setObject(Y,R),We===!0&&it.setState(R,J,!1),R.transparent===!0&&R.side===$n&&R.forceSinglePass===!1?(R.side=Cn,R.needsUpdate=!0,ji(R,G,Y),R.side=Mi,R.needsUpdate=!0,ji(R,G,Y),R.side=$n):ji(R,G,Y)}this.compile=function(R,G,J=null){J===null&&(J=R),I!==null&&I.renderStart(R,G,J),T=tt.get(J),T.init(G),b.push(T),J.traverseVisible(function($){$.isLight&&$.layers.test(G.layers)&&(T.pushLight($),$.castShadow&&T.pushShadow($))}),R!==J&&R.traverseVisible(function($){$.isLight&&$.layers.test(G.layers)&&(T.pushLight($),$.castShadow&&T.pushShadow($))}),T.setupLights(),I!==null&&I.updateLights(T.state.lightsArray),gn=this.localClippingEnabled,We=it.init(this.clippingPlanes,gn),We===!0&&it.setGlobalState(this.clippingPlanes,G),I!==null&&pt.render(T.state.shadowsArray,J,G);let Y=new Set;return R.traverse(function($){if(!($.isMesh||$.isPoints||$.isLine||$.isSprite))return;let Tt=$.material;if(Tt)if(Array.isArray(Tt))for(let Pt=0;Pt<Tt.length;Pt++){let At=Tt[Pt];ma(At,J,G,$),Y.add(At)}else ma(Tt,J,G,$),Y.add(Tt)}),T=b.pop(),I!==null&&I.renderEnd(),Y},this.compileAsync=function(R,G,J=null){let Y=this.compile(R,G,J);return new Promise($=>{function Tt(){if(Y.forEach(function(Pt){let It=Gt.get(Pt).currentProgram;(It===void 0||It.isReady())&&Y.delete(Pt)}),Y.size===0){$(R);return}setTimeout(Tt,10)}Zt.get("KHR_parallel_shader_compile")!==null?Tt():setTimeout(Tt,10)})};let Xr=null;function xf(R){Xr&&Xr(R)}function Bl(){xs.stop()}function Ji(){xs.start()}let xs=new I0;xs.setAnimationLoop(xf),typeof self<"u"&&xs.setContext(self),this.setAnimationLoop=function(R){Xr=R,lt.setAnimationLoop(R),R===null?xs.stop():xs.start()},lt.addEventListener("sessionstart",Bl),lt.addEventListener("sessionend",Ji),this.render=function(R,G){if(G!==void 0&&G.isCamera!==!0){Qt("WebGLRenderer.render: camera is not an instance of THREE.Camera.");return}if(P===!0)return;I!==null&&I.renderStart(R,G);let J=lt.enabled===!0&&lt.isPresenting===!0,Y=D!==null&&(at===null||J)&&D.begin(C,at);if(R.matrixWorldAutoUpdate===!0&&R.updateMatrixWorld(),G.parent===null&&G.matrixWorldAutoUpdate===!0&&G.updateMatrixWorld(),lt.enabled===!0&&lt.isPresenting===!0&&(D===null||D.isCompositing()===!1)&&(lt.cameraAutoUpdate===!0&&lt.updateCamera(G),G=lt.getCamera()),R.isScene===!0&&R.onBeforeRender(C,R,G,at),T=tt.get(R,b.length),T.init(G),T.state.textureUnits=qt.getTextureUnits(),b.push(T),Ue.multiplyMatrices(G.projectionMatrix,G.matrixWorldInverse),G.isArrayCamera?Qe.setFromArrayCamera(G):se.setFromProjectionMatrix(Ue,Ii,G.reversedDepth),gn=this.localClippingEnabled,We=it.init(this.clippingPlanes,gn),w=yt.get(R,x.length),w.init(),x.push(w),this.info.render.frame++,lt.enabled===!0&&lt.isPresenting===!0){let Pt=C.xr.getDepthSensingMesh();Pt!==null&&ys(Pt,G,-1/0,C.sortObjects)}ys(R,G,0,C.sortObjects),w.finish(),I!==null&&I.updateLights(T.state.lightsArray),C.sortObjects===!0&&w.sort(Ht,ne),rn=lt.enabled===!1||lt.isPresenting===!1||lt.hasDepthSensing()===!1,rn&&k.addToRenderList(w,R),this.info.autoReset===!0&&this.info.reset(),We===!0&&it.beginShadows();let $=T.state.shadowsArray;if(pt.render($,R,G),We===!0&&it.endShadows(),(Y&&D.hasRenderPass())===!1){let Pt=w.opaque,At=w.transmissive;if(T.setupLights(),G.isArrayCamera){let It=G.cameras;if(At.length>0)for(let zt=0,ee=It.length;zt<ee;zt++){let de=It[zt];Ui(Pt,At,R,de)}rn&&k.render(R);for(let zt=0,ee=It.length;zt<ee;zt++){let de=It[zt];ga(w,R,de,de.viewport)}}else At.length>0&&Ui(Pt,At,R,G),rn&&k.render(R),ga(w,R,G)}at!==null&&H===0&&(qt.updateMultisampleRenderTarget(at),qt.updateRenderTargetMipmap(at)),Y&&D.end(C),R.isScene===!0&&R.onAfterRender(C,R,G),Mt.resetDefaultState(),Z=-1,j=null,b.pop(),b.length>0?(T=b[b.length-1],qt.setTextureUnits(T.state.textureUnits),We===!0&&it.setGlobalState(C.clippingPlanes,T.state.camera)):T=null,x.pop(),x.length>0?w=x[x.length-1]:w=null,I!==null&&I.renderEnd()};function ys(R,G,J,Y){if(R.visible===!1)return;if(R.layers.test(G.layers)){if(R.isGroup)J=R.renderOrder;else if(R.isLOD)R.autoUpdate===!0&&R.update(G);else if(R.isLight)T.pushLight(R),R.castShadow&&T.pushShadow(R);else if(R.isSprite){let Pt=G.isArrayCamera?Qe:se;if(!R.frustumCulled||R.intersectsFrustum(Pt)){Y&&ve.setFromMatrixPosition(R.matrixWorld).applyMatrix4(Ue);let At=ct.update(R),It=R.material;It.visible&&w.push(R,At,It,J,ve.z,null,G)}}else if(R.isMesh||R.isLine||R.isPoints){let Pt=G.isArrayCamera?Qe:se;if(!R.frustumCulled||R.intersectsFrustum(Pt)){let At=ct.update(R),It=R.material;if(Y&&(R.boundingSphere!==void 0?(R.boundingSphere===null&&R.computeBoundingSphere(),ve.copy(R.boundingSphere.center)):(At.boundingSphere===null&&At.computeBoundingSphere(),ve.copy(At.boundingSphere.center)),ve.applyMatrix4(R.matrixWorld).applyMatrix4(Ue)),Array.isArray(It)){let zt=At.groups;for(let ee=0,de=zt.length;ee<de;ee++){let Bt=zt[ee],pe=It[Bt.materialIndex];pe&&pe.visible&&w.push(R,At,pe,J,ve.z,Bt,G)}}else It.visible&&w.push(R,At,It,J,ve.z,null,G)}}}let Tt=R.children;for(let Pt=0,At=Tt.length;Pt<At;Pt++)ys(Tt[Pt],G,J,Y)}function ga(R,G,J,Y){let{opaque:$,transmissive:Tt,transparent:Pt}=R;T.setupLightsView(J),We===!0&&it.setGlobalState(C.clippingPlanes,J),Y&&bt.viewport(nt.copy(Y)),$.length>0&&on($,G,J),Tt.length>0&&on(Tt,G,J),Pt.length>0&&on(Pt,G,J),bt.buffers.depth.setTest(!0),bt.buffers.depth.setMask(!0),bt.buffers.color.setMask(!0),bt.setPolygonOffset(!1)}function Ui(R,G,J,Y){if((J.isScene===!0?J.overrideMaterial:null)!==null)return;if(T.state.transmissionRenderTarget[Y.id]===void 0){let Bt=Zt.has("EXT_color_buffer_half_float")||Zt.has("EXT_color_buffer_float");T.state.transmissionRenderTarget[Y.id]=new vi(1,1,{generateMipmaps:!0,type:Bt?Wi:hi,minFilter:Ns,samples:Math.max(4,oe.samples),stencilBuffer:r,resolveDepthBuffer:!1,resolveStencilBuffer:!1,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,colorSpace:xe.workingColorSpace})}let Tt=T.state.transmissionRenderTarget[Y.id],Pt=Y.viewport||nt;Tt.setSize(Pt.z*C.transmissionResolutionScale,Pt.w*C.transmissionResolutionScale);let At=C.getRenderTarget(),It=C.getActiveCubeFace(),zt=C.getActiveMipmapLevel();C.setRenderTarget(Tt),C.getClearColor(Q),dt=C.getClearAlpha(),dt<1&&C.setClearColor(16777215,.5),C.clear(),rn&&k.render(J);let ee=C.toneMapping;C.toneMapping=hs;let de=Y.viewport;if(Y.viewport!==void 0&&(Y.viewport=void 0),T.setupLightsView(Y),We===!0&&it.setGlobalState(C.clippingPlanes,Y),on(R,J,Y),qt.updateMultisampleRenderTarget(Tt),qt.updateRenderTargetMipmap(Tt),Zt.has("WEBGL_multisampled_render_to_texture")===!1){let Bt=!1;for(let pe=0,sn=G.length;pe<sn;pe++){let Le=G[pe],{object:De,geometry:Tn,material:Ut,group:xn}=Le;if(Ut.side===$n&&De.layers.test(Y.layers)){let _e=Ut.side;Ut.side=Cn,Ut.needsUpdate=!0,un(De,J,Y,Tn,Ut,xn),Ut.side=_e,Ut.needsUpdate=!0,Bt=!0}}Bt===!0&&(qt.updateMultisampleRenderTarget(Tt),qt.updateRenderTargetMipmap(Tt))}C.setRenderTarget(At,It,zt),C.setClearColor(Q,dt),de!==void 0&&(Y.viewport=de),C.toneMapping=ee}function on(R,G,J){let Y=G.isScene===!0?G.overrideMaterial:null;for(let $=0,Tt=R.length;$<Tt;$++){let Pt=R[$],{object:At,geometry:It,group:zt}=Pt,ee=Pt.material;ee.allowOverride===!0&&Y!==null&&(ee=Y),At.layers.test(J.layers)&&un(At,G,J,It,ee,zt)}}function un(R,G,J,Y,$,Tt){I!==null&&$.isNodeMaterial&&I.setObject(R,$),R.onBeforeRender(C,G,J,Y,$,Tt),R.modelViewMatrix.multiplyMatrices(J.matrixWorldInverse,R.matrixWorld),R.normalMatrix.getNormalMatrix(R.modelViewMatrix),$.onBeforeRender(C,G,J,Y,R,Tt),$.transparent===!0&&$.side===$n&&$.forceSinglePass===!1?($.side=Cn,$.needsUpdate=!0,C.renderBufferDirect(J,G,Y,$,R,Tt),$.side=Mi,$.needsUpdate=!0,C.renderBufferDirect(J,G,Y,$,R,Tt),$.side=$n):C.renderBufferDirect(J,G,Y,$,R,Tt),R.onAfterRender(C,G,J,Y,$,Tt)}function fn(R){let G=0;for(let J of R)J.texture!==null&&G++;return G}function ji(R,G,J){G.isScene!==!0&&(G=wn);let Y=Gt.get(R),$=T.state.lights,Tt=T.state.shadowsArray,Pt=$.state.version,At=rt.getParameters(R,$.state,Tt,G,J,T.state.lightProbeGridArray),It=rt.getProgramCacheKey(At),zt=Y.programs;Y.environment=R.isMeshStandardMaterial||R.isMeshLambertMaterial||R.isMeshPhongMaterial?G.environment:null,Y.fog=G.fog;let ee=R.isMeshStandardMaterial||R.isMeshLambertMaterial&&!R.envMap||R.isMeshPhongMaterial&&!R.envMap;Y.envMap=N.get(R.envMap||Y.environment,ee),Y.envMapRotation=Y.environment!==null&&R.envMap===null?G.environmentRotation:R.envMapRotation,zt===void 0&&(R.addEventListener("dispose",ce),zt=new Map,Y.programs=zt,Y.programVariants=new Map);let de=zt.get(It);if(de!==void 0){if(Y.currentProgram===de&&Y.lightsStateVersion===Pt)return _a(R,At),de}else At.uniforms=rt.getUniforms(R),I!==null&&R.isNodeMaterial&&I.build(R,J,At),R.onBeforeCompile(At,C),de=rt.acquireProgram(At,It),zt.set(It,de),Y.uniforms=At.uniforms;let Bt=Y.uniforms;return(!R.isShaderMaterial&&!R.isRawShaderMaterial||R.clipping===!0)&&(Bt.clippingPlanes=it.uniform),_a(R,At),Y.needsLights=Vs(R),Y.lightsStateVersion=Pt,Y.needsLights&&(Bt.ambientLightColor.value=$.state.ambient,Bt.lightProbe.value=$.state.probe,Bt.sunLights.value=$.state.sun,Bt.sunLightShadows.value=$.state.sunShadow,Bt.directionalLights.value=$.state.directional,Bt.directionalLightShadows.value=$.state.directionalShadow,Bt.spotLights.value=$.state.spot,Bt.spotLightShadows.value=$.state.spotShadow,Bt.rectAreaLights.value=$.state.rectArea,Bt.ltc_1.value=$.state.rectAreaLTC1,Bt.ltc_2.value=$.state.rectAreaLTC2,Bt.pointLights.value=$.state.point,Bt.pointLightShadows.value=$.state.pointShadow,Bt.hemisphereLights.value=$.state.hemi,Bt.sunShadowMatrix.value=$.state.sunShadowMatrix,Bt.sunShadowCascade.value=$.state.sunShadowCascade,Bt.directionalShadowMatrix.value=$.state.directionalShadowMatrix,Bt.spotLightMatrix.value=$.state.spotLightMatrix,Bt.spotLightMap.value=$.state.spotLightMap,Bt.pointShadowMatrix.value=$.state.pointShadowMatrix),Y.numLightProbeGrids=fn(T.state.lightProbeGridArray),Y.currentProgram=de,Y.uniformsList=null,de}function di(R,G,J,Y,$){let Tt=Gt.get(R),Pt=Tt.currentProgram.id+","+Y+","+$,At=Tt.programVariants.get(Pt);return At===void 0?(At=ji(R,G,J),Tt.programVariants.set(Pt,At)):(Tt.currentProgram=At,Tt.uniformsList=null,Tt.outputColorSpace=Y,Tt.toneMapping=$),At}function ks(R){if(R.uniformsList===null){let G=R.currentProgram.getUniforms();R.uniformsList=zo.seqWithValue(G.seq,R.uniforms)}return R.uniformsList}function _a(R,G){let J=Gt.get(R);J.outputColorSpace=G.outputColorSpace,J.batching=G.batching,J.batchingColor=G.batchingColor,J.instancing=G.instancing,J.instancingColor=G.instancingColor,J.instancingMorph=G.instancingMorph,J.skinning=G.skinning,J.morphTargets=G.morphTargets,J.morphNormals=G.morphNormals,J.morphColors=G.morphColors,J.morphTargetsCount=G.morphTargetsCount,J.numClippingPlanes=G.numClippingPlanes,J.numIntersection=G.numClipIntersection,J.vertexAlphas=G.vertexAlphas,J.vertexTangents=G.vertexTangents,J.toneMapping=G.toneMapping}function xa(R,G,J,Y,$){G.isScene!==!0&&(G=wn),qt.resetTextureUnits();let Tt=G.fog,Pt=Y.isMeshStandardMaterial||Y.isMeshLambertMaterial||Y.isMeshPhongMaterial?G.environment:null,At=at===null?C.outputColorSpace:at.isXRRenderTarget===!0?at.texture.colorSpace:xe.workingColorSpace,It=Y.isMeshStandardMaterial||Y.isMeshLambertMaterial&&!Y.envMap||Y.isMeshPhongMaterial&&!Y.envMap,zt=N.get(Y.envMap||Pt,It),ee=Y.vertexColors===!0&&!!J.attributes.color&&J.attributes.color.itemSize===4,de=!!J.attributes.tangent&&(!!Y.normalMap||Y.anisotropy>0),Bt=!!J.morphAttributes.position,pe=!!J.morphAttributes.normal,sn=!!J.morphAttributes.color,Le=hs;Y.toneMapped&&(at===null||at.isXRRenderTarget===!0)&&(Le=C.toneMapping);let De=J.morphAttributes.position||J.morphAttributes.normal||J.morphAttributes.color,Tn=De!==void 0?De.length:0,Ut=Gt.get(Y),xn=T.state.lights;if(We===!0&&(gn===!0||R!==j)){let Ne=R===j&&Y.id===Z;it.setState(Y,R,Ne)}let _e=!1,vs=!1;Y.version===Ut.__version?Ut.needsLights&&Ut.lightsStateVersion!==xn.state.version||$.isBatchedMesh&&Ut.batching===!1||!$.isBatchedMesh&&Ut.batching===!0||$.isBatchedMesh&&Ut.batchingColor===!0&&$._colorsTexture===null||$.isBatchedMesh&&Ut.batchingColor===!1&&$._colorsTexture!==null||$.isInstancedMesh&&Ut.instancing===!1||!$.isInstancedMesh&&Ut.instancing===!0||$.isSkinnedMesh&&Ut.skinning===!1||!$.isSkinnedMesh&&Ut.skinning===!0||$.isInstancedMesh&&Ut.instancingColor===!0&&$.instanceColor===null||$.isInstancedMesh&&Ut.instancingColor===!1&&$.instanceColor!==null||$.isInstancedMesh&&Ut.instancingMorph===!0&&$.morphTexture===null||$.isInstancedMesh&&Ut.instancingMorph===!1&&$.morphTexture!==null||Ut.envMap!==zt||Y.fog===!0&&Ut.fog!==Tt||Ut.numClippingPlanes!==void 0&&(Ut.numClippingPlanes!==it.numPlanes||Ut.numIntersection!==it.numIntersection)||Ut.vertexAlphas!==ee||Ut.vertexTangents!==de||Ut.morphTargets!==Bt||Ut.morphNormals!==pe||Ut.morphColors!==sn||Ut.morphTargetsCount!==Tn||Ut.numLightProbeGrids!==fn(T.state.lightProbeGridArray)?_e=!0:(Ut.outputColorSpace!==At||Ut.toneMapping!==Le)&&(vs=!0):(_e=!0,Ut.__version=Y.version);let yn=Ut.currentProgram;(_e===!0||vs===!0)&&(yn=vs===!0?di(Y,G,$,At,Le):ji(Y,G,$),I&&Y.isNodeMaterial&&I.onUpdateProgram(Y,yn,Ut));let Zr=!1,Qi=!1,Ss=!1,ue=yn.getUniforms(),an=Ut.uniforms;if(bt.useProgram(yn.program)&&(Zr=!0,Qi=!0,Ss=!0),Y.id!==Z&&(Z=Y.id,Qi=!0),Zr||j!==R){bt.buffers.depth.getReversed()&&R.reversedDepth!==!0&&(R._reversedDepth=!0,R.updateProjectionMatrix()),ue.setValue(V,"projectionMatrix",R.projectionMatrix),ue.setValue(V,"viewMatrix",R.matrixWorldInverse);let vn=ue.map.cameraPosition;vn!==void 0&&vn.setValue(V,Nn.setFromMatrixPosition(R.matrixWorld)),oe.logarithmicDepthBuffer&&ue.setValue(V,"logDepthBufFC",2/(Math.log(R.far+1)/Math.LN2)),(Y.isMeshPhongMaterial||Y.isMeshToonMaterial||Y.isMeshLambertMaterial||Y.isMeshBasicMaterial||Y.isMeshStandardMaterial||Y.isShaderMaterial)&&ue.setValue(V,"isOrthographic",R.isOrthographicCamera===!0),j!==R&&(j=R,Qi=!0,Ss=!0)}if(Ut.needsLights&&(xn.state.sunShadowMap.length>0&&ue.setValue(V,"sunShadowMap",xn.state.sunShadowMap,qt),xn.state.directionalShadowMap.length>0&&ue.setValue(V,"directionalShadowMap",xn.state.directionalShadowMap,qt),xn.state.spotShadowMap.length>0&&ue.setValue(V,"spotShadowMap",xn.state.spotShadowMap,qt),xn.state.pointShadowMap.length>0&&ue.setValue(V,"pointShadowMap",xn.state.pointShadowMap,qt)),$.isSkinnedMesh){ue.setOptional(V,$,"bindMatrix"),ue.setOptional(V,$,"bindMatrixInverse");let Ne=$.skeleton;Ne&&(Ne.boneTexture===null&&Ne.computeBoneTexture(),ue.setValue(V,"boneTexture",Ne.boneTexture,qt))}$.isBatchedMesh&&(ue.setOptional(V,$,"batchingTexture"),ue.setValue(V,"batchingTexture",$._matricesTexture,qt),ue.setOptional(V,$,"batchingIdTexture"),ue.setValue(V,"batchingIdTexture",$._indirectTexture,qt),ue.setOptional(V,$,"batchingColorTexture"),$._colorsTexture!==null&&ue.setValue(V,"batchingColorTexture",$._colorsTexture,qt));let Qn=J.morphAttributes;if((Qn.position!==void 0||Qn.normal!==void 0||Qn.color!==void 0)&&st.update($,J,yn),(Qi||Ut.receiveShadow!==$.receiveShadow)&&(Ut.receiveShadow=$.receiveShadow,ue.setValue(V,"receiveShadow",$.receiveShadow)),(Y.isMeshStandardMaterial||Y.isMeshLambertMaterial||Y.isMeshPhongMaterial)&&Y.envMap===null&&G.environment!==null&&(an.envMapIntensity.value=G.environmentIntensity),an.dfgLUT!==void 0&&(an.dfgLUT.value=U1()),Qi){if(ue.setValue(V,"toneMappingExposure",C.toneMappingExposure),Ut.needsLights&&qr(an,Ss),Tt&&Y.fog===!0&&xt.refreshFogUniforms(an,Tt),xt.refreshMaterialUniforms(an,Y,St,Et,T.state.transmissionRenderTarget[R.id]),Ut.needsLights&&Ut.numLightProbeGrids>0){let Ne=y,vn=0;for(let qn of T.state.lightProbeGridArray)qn.texture!==null&&(Ne.textures[vn]=qn.texture,Ne.min[vn]=qn.boundingBox.min,Ne.max[vn]=qn.boundingBox.max,Ne.resolution[vn]=qn.resolution,vn++);for(let qn in Ne)Ne[qn].length=vn;an.probesSH.value=Ne.textures,an.probesMin.value=Ne.min,an.probesMax.value=Ne.max,an.probesResolution.value=Ne.resolution}zo.upload(V,ks(Ut),an,qt)}if(Y.isShaderMaterial&&Y.uniformsNeedUpdate===!0&&(zo.upload(V,ks(Ut),an,qt),Y.uniformsNeedUpdate=!1),Y.isSpriteMaterial&&ue.setValue(V,"center",$.center),ue.setValue(V,"modelViewMatrix",$.modelViewMatrix),ue.setValue(V,"normalMatrix",$.normalMatrix),ue.setValue(V,"modelMatrix",$.matrixWorld),Y.uniformsGroups!==void 0){let Ne=Y.uniformsGroups;for(let vn=0,qn=Ne.length;vn<qn;vn++){let zl=Ne[vn];Wt.update(zl,yn),Wt.bind(zl,yn)}}return yn}function qr(R,G){R.ambientLightColor.needsUpdate=G,R.lightProbe.needsUpdate=G,R.sunLights.needsUpdate=G,R.sunLightShadows.needsUpdate=G,R.directionalLights.needsUpdate=G,R.directionalLightShadows.needsUpdate=G,R.pointLights.needsUpdate=G,R.pointLightShadows.needsUpdate=G,R.spotLights.needsUpdate=G,R.spotLightShadows.needsUpdate=G,R.rectAreaLights.needsUpdate=G,R.hemisphereLights.needsUpdate=G}function Vs(R){return R.isMeshLambertMaterial||R.isMeshToonMaterial||R.isMeshPhongMaterial||R.isMeshStandardMaterial||R.isShadowMaterial||R.isShaderMaterial&&R.lights===!0}this.getActiveCubeFace=function(){return X},this.getActiveMipmapLevel=function(){return H},this.getRenderTarget=function(){return at},this.setRenderTargetTextures=function(R,G,J){let Y=Gt.get(R);Y.__autoAllocateDepthBuffer=R.resolveDepthBuffer===!1,Y.__autoAllocateDepthBuffer===!1&&(Y.__useRenderToTexture=!1),Gt.get(R.texture).__webglTexture=G,Gt.get(R.depthTexture).__webglTexture=Y.__autoAllocateDepthBuffer?void 0:J,Y.__hasExternalTextures=!0},this.setRenderTargetFramebuffer=function(R,G){let J=Gt.get(R);J.__webglFramebuffer=G,J.__useDefaultFramebuffer=G===void 0},this.setRenderTarget=function(R,G=0,J=0){at=R,X=G,H=J;let Y=null,$=!1,Tt=!1;if(R){let At=Gt.get(R);if(At.__useDefaultFramebuffer!==void 0){bt.bindFramebuffer(V.FRAMEBUFFER,At.__webglFramebuffer),nt.copy(R.viewport),ut.copy(R.scissor),ht=R.scissorTest,bt.viewport(nt),bt.scissor(ut),bt.setScissorTest(ht),Z=-1;return}else if(At.__webglFramebuffer===void 0)qt.setupRenderTarget(R);else if(At.__hasExternalTextures)qt.rebindTextures(R,Gt.get(R.texture).__webglTexture,Gt.get(R.depthTexture).__webglTexture);else if(R.depthBuffer){let ee=R.depthTexture;if(At.__boundDepthTexture!==ee){if(ee!==null&&Gt.has(ee)&&(R.width!==ee.image.width||R.height!==ee.image.height))throw new Error("THREE.WebGLRenderer: Attached DepthTexture is initialized to the incorrect size.");qt.setupDepthRenderbuffer(R)}}let It=R.texture;(It.isData3DTexture||It.isDataArrayTexture||It.isCompressedArrayTexture)&&(Tt=!0);let zt=Gt.get(R).__webglFramebuffer;R.isWebGLCubeRenderTarget?(Array.isArray(zt[G])?Y=zt[G][J]:Y=zt[G],$=!0):R.samples>0&&qt.useMultisampledRTT(R)===!1?Y=Gt.get(R).__webglMultisampledFramebuffer:Array.isArray(zt)?Y=zt[J]:Y=zt,nt.copy(R.viewport),ut.copy(R.scissor),ht=R.scissorTest}else nt.copy(Vt).multiplyScalar(St).floor(),ut.copy(le).multiplyScalar(St).floor(),ht=he;if(J!==0&&(Y=O),bt.bindFramebuffer(V.FRAMEBUFFER,Y)&&bt.drawBuffers(R,Y),bt.viewport(nt),bt.scissor(ut),bt.setScissorTest(ht),$){let At=Gt.get(R.texture);V.framebufferTexture2D(V.FRAMEBUFFER,V.COLOR_ATTACHMENT0,V.TEXTURE_CUBE_MAP_POSITIVE_X+G,At.__webglTexture,J)}else if(Tt){let At=G;for(let It=0;It<R.textures.length;It++){let zt=Gt.get(R.textures[It]);V.framebufferTextureLayer(V.FRAMEBUFFER,V.COLOR_ATTACHMENT0+It,zt.__webglTexture,J,At)}}else if(R!==null&&J!==0){let At=Gt.get(R.texture);V.framebufferTexture2D(V.FRAMEBUFFER,V.COLOR_ATTACHMENT0,V.TEXTURE_2D,At.__webglTexture,J)}Z=-1};function Yr(R){let G=Gt.get(R);return(G.__readFormat!==R.format||G.__readType!==R.type)&&(G.__readFormat=R.format,G.__readType=R.type,G.__formatReadable=oe.textureFormatReadable(R.format),G.__typeReadable=oe.textureTypeReadable(R.type)),G}this.readRenderTargetPixels=function(R,G,J,Y,$,Tt,Pt,At=0){if(!(R&&R.isWebGLRenderTarget)){Qt("WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");return}let It=Gt.get(R).__webglFramebuffer;if(R.isWebGLCubeRenderTarget&&Pt!==void 0&&(It=It[Pt],Array.isArray(It)&&(It=It[0])),It){bt.bindFramebuffer(V.FRAMEBUFFER,It);try{let zt=R.textures[At],ee=zt.format,de=zt.type;R.textures.length>1&&V.readBuffer(V.COLOR_ATTACHMENT0+At);let Bt=Yr(zt);if(Bt.__formatReadable===!1){Qt("WebGLRenderer.readRenderTargetPixels: renderTarget is not in RGBA or implementation defined format.");return}if(Bt.__typeReadable===!1){Qt("WebGLRenderer.readRenderTargetPixels: renderTarget is not in UnsignedByteType or implementation defined type.");return}G>=0&&G<=R.width-Y&&J>=0&&J<=R.height-$&&V.readPixels(G,J,Y,$,_t.convert(ee),_t.convert(de),Tt)}finally{let zt=at!==null?Gt.get(at).__webglFramebuffer:null;bt.bindFramebuffer(V.FRAMEBUFFER,zt)}}},this.readRenderTargetPixelsAsync=async function(R,G,J,Y,$,Tt,Pt,At=0){if(!(R&&R.isWebGLRenderTarget))throw new Error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");let It=Gt.get(R).__webglFramebuffer;if(R.isWebGLCubeRenderTarget&&Pt!==void 0&&(It=It[Pt],Array.isArray(It)&&(It=It[0])),It)if(G>=0&&G<=R.width-Y&&J>=0&&J<=R.height-$){bt.bindFramebuffer(V.FRAMEBUFFER,It);let zt=R.textures[At],ee=zt.format,de=zt.type;R.textures.length>1&&V.readBuffer(V.COLOR_ATTACHMENT0+At);let Bt=Yr(zt);if(Bt.__formatReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in RGBA or implementation defined format.");if(Bt.__typeReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in UnsignedByteType or implementation defined type.");let pe=V.createBuffer();V.bindBuffer(V.PIXEL_PACK_BUFFER,pe),V.bufferData(V.PIXEL_PACK_BUFFER,Tt.byteLength,V.STREAM_READ),V.readPixels(G,J,Y,$,_t.convert(ee),_t.convert(de),0),V.bindBuffer(V.PIXEL_PACK_BUFFER,null);let sn=at!==null?Gt.get(at).__webglFramebuffer:null;bt.bindFramebuffer(V.FRAMEBUFFER,sn);let Le=V.fenceSync(V.SYNC_GPU_COMMANDS_COMPLETE,0);return V.flush(),await n0(V,Le,4),V.bindBuffer(V.PIXEL_PACK_BUFFER,pe),V.getBufferSubData(V.PIXEL_PACK_BUFFER,0,Tt),V.bindBuffer(V.PIXEL_PACK_BUFFER,null),V.deleteBuffer(pe),V.deleteSync(Le),Tt}else throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: requested read bounds are out of range.")},this.copyFramebufferToTexture=function(R,G=null,J=0){let Y=Math.pow(2,-J),$=Math.floor(R.image.width*Y),Tt=Math.floor(R.image.height*Y),Pt=G!==null?G.x:0,At=G!==null?G.y:0;qt.setTexture2D(R,0),V.copyTexSubImage2D(V.TEXTURE_2D,J,0,0,Pt,At,$,Tt),bt.unbindTexture()},this.copyTextureToTexture=function(R,G,J=null,Y=null,$=0,Tt=0){let Pt,At,It,zt,ee,de,Bt,pe,sn,Le=R.isCompressedTexture?R.mipmaps[Tt]:R.image;if(J!==null)Pt=J.max.x-J.min.x,At=J.max.y-J.min.y,It=J.isBox3?J.max.z-J.min.z:1,zt=J.min.x,ee=J.min.y,de=J.isBox3?J.min.z:0;else{let ue=Math.pow(2,-$);Pt=Math.floor(Le.width*ue),At=Math.floor(Le.height*ue),R.isDataArrayTexture?It=Le.depth:R.isData3DTexture?It=Math.floor(Le.depth*ue):It=1,zt=0,ee=0,de=0}Y!==null?(Bt=Y.x,pe=Y.y,sn=Y.z):(Bt=0,pe=0,sn=0);let De=_t.convert(G.format),Tn=_t.convert(G.type),Ut;G.isData3DTexture?(qt.setTexture3D(G,0),Ut=V.TEXTURE_3D):G.isDataArrayTexture||G.isCompressedArrayTexture?(qt.setTexture2DArray(G,0),Ut=V.TEXTURE_2D_ARRAY):(qt.setTexture2D(G,0),Ut=V.TEXTURE_2D),bt.activeTexture(V.TEXTURE0),bt.pixelStorei(V.UNPACK_FLIP_Y_WEBGL,G.flipY),bt.pixelStorei(V.UNPACK_PREMULTIPLY_ALPHA_WEBGL,G.premultiplyAlpha),bt.pixelStorei(V.UNPACK_ALIGNMENT,G.unpackAlignment);let xn=bt.getParameter(V.UNPACK_ROW_LENGTH),_e=bt.getParameter(V.UNPACK_IMAGE_HEIGHT),vs=bt.getParameter(V.UNPACK_SKIP_PIXELS),yn=bt.getParameter(V.UNPACK_SKIP_ROWS),Zr=bt.getParameter(V.UNPACK_SKIP_IMAGES);bt.pixelStorei(V.UNPACK_ROW_LENGTH,Le.width),bt.pixelStorei(V.UNPACK_IMAGE_HEIGHT,Le.height),bt.pixelStorei(V.UNPACK_SKIP_PIXELS,zt),bt.pixelStorei(V.UNPACK_SKIP_ROWS,ee),bt.pixelStorei(V.UNPACK_SKIP_IMAGES,de);let Qi=R.isDataArrayTexture||R.isData3DTexture,Ss=G.isDataArrayTexture||G.isData3DTexture;if(R.isDepthTexture){let ue=Gt.get(R),an=Gt.get(G),Qn=Gt.get(ue.__renderTarget),Ne=Gt.get(an.__renderTarget);bt.bindFramebuffer(V.READ_FRAMEBUFFER,Qn.__webglFramebuffer),bt.bindFramebuffer(V.DRAW_FRAMEBUFFER,Ne.__webglFramebuffer);for(let vn=0;vn<It;vn++)Qi&&(V.framebufferTextureLayer(V.READ_FRAMEBUFFER,V.COLOR_ATTACHMENT0,Gt.get(R).__webglTexture,$,de+vn),V.framebufferTextureLayer(V.DRAW_FRAMEBUFFER,V.COLOR_ATTACHMENT0,Gt.get(G).__webglTexture,Tt,sn+vn)),V.blitFramebuffer(zt,ee,zt+Pt,ee+At,Bt,pe,Bt+Pt,pe+At,V.DEPTH_BUFFER_BIT,V.NEAREST);bt.bindFramebuffer(V.READ_FRAMEBUFFER,null),bt.bindFramebuffer(V.DRAW_FRAMEBUFFER,null)}else if($!==0||R.isRenderTargetTexture||Gt.has(R)){let ue=Gt.get(R),an=Gt.get(G);bt.bindFramebuffer(V.READ_FRAMEBUFFER,L),bt.bindFramebuffer(V.DRAW_FRAMEBUFFER,z);for(let Qn=0;Qn<It;Qn++)Qi?V.framebufferTextureLayer(V.READ_FRAMEBUFFER,V.COLOR_ATTACHMENT0,ue.__webglTexture,$,de+Qn):V.framebufferTexture2D(V.READ_FRAMEBUFFER,V.COLOR_ATTACHMENT0,V.TEXTURE_2D,ue.__webglTexture,$),Ss?V.framebufferTextureLayer(V.DRAW_FRAMEBUFFER,V.COLOR_ATTACHMENT0,an.__webglTexture,Tt,sn+Qn):V.framebufferTexture2D(V.DRAW_FRAMEBUFFER,V.COLOR_ATTACHMENT0,V.TEXTURE_2D,an.__webglTexture,Tt),$!==0?V.blitFramebuffer(zt,ee,zt+Pt,ee+At,Bt,pe,Bt+Pt,pe+At,V.COLOR_BUFFER_BIT,V.NEAREST):Ss?V.copyTexSubImage3D(Ut,Tt,Bt,pe,sn+Qn,zt,ee,Pt,At):V.copyTexSubImage2D(Ut,Tt,Bt,pe,zt,ee,Pt,At);bt.bindFramebuffer(V.READ_FRAMEBUFFER,null),bt.bindFramebuffer(V.DRAW_FRAMEBUFFER,null)}else Ss?R.isDataTexture||R.isData3DTexture?V.texSubImage3D(Ut,Tt,Bt,pe,sn,Pt,At,It,De,Tn,Le.data):G.isCompressedArrayTexture?V.compressedTexSubImage3D(Ut,Tt,Bt,pe,sn,Pt,At,It,De,Le.data):V.texSubImage3D(Ut,Tt,Bt,pe,sn,Pt,At,It,De,Tn,Le):R.isDataTexture?V.texSubImage2D(V.TEXTURE_2D,Tt,Bt,pe,Pt,At,De,Tn,Le.data):R.isCompressedTexture?V.compressedTexSubImage2D(V.TEXTURE_2D,Tt,Bt,pe,Le.width,Le.height,De,Le.data):V.texSubImage2D(V.TEXTURE_2D,Tt,Bt,pe,Pt,At,De,Tn,Le);bt.pixelStorei(V.UNPACK_ROW_LENGTH,xn),bt.pixelStorei(V.UNPACK_IMAGE_HEIGHT,_e),bt.pixelStorei(V.UNPACK_SKIP_PIXELS,vs),bt.pixelStorei(V.UNPACK_SKIP_ROWS,yn),bt.pixelStorei(V.UNPACK_SKIP_IMAGES,Zr),Tt===0&&G.generateMipmaps===!0&&G.mipmapsAutoUpdate===!0&&V.generateMipmap(Ut),bt.unbindTexture()},this.initRenderTarget=function(R){Gt.get(R).__webglFramebuffer===void 0&&qt.setupRenderTarget(R)},this.initTexture=function(R){R.isCubeTexture?qt.setTextureCube(R,0):R.isData3DTexture?qt.setTexture3D(R,0):R.isDataArrayTexture||R.isCompressedArrayTexture?qt.setTexture2DArray(R,0):qt.setTexture2D(R,0),bt.unbindTexture()},this.resetState=function(){X=0,H=0,at=null,bt.reset(),Mt.reset()},typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}get coordinateSystem(){return Ii}get outputColorSpace(){return this._outputColorSpace}set outputColorSpace(t){this._outputColorSpace=t;let e=this.getContext();e.drawingBufferColorSpace=xe._getDrawingBufferColorSpace(t),e.unpackColorSpace=xe._getUnpackColorSpace()}};function np({options:i,theme:t,picture:e}){return{f:()=>i.toggleFull(),d:()=>t.toggle(),r:()=>e?.resetView(),c:()=>e&&i.toggleCut(),m:()=>e&&i.showDistance(!e.colours.on)}}function G0({clock:i,transport:t,...e}){return{" ":()=>i.toggle(),ArrowLeft:n=>i.step(n.shiftKey?-10:-1),ArrowRight:n=>i.step(n.shiftKey?10:1),ArrowUp:()=>t.changeSpeed(1),ArrowDown:()=>t.changeSpeed(-1),Home:()=>i.seekSample(0),End:()=>i.seekSample(i.last),l:()=>t.toggleLoop(),...np(e)}}function ip(i){return i.target instanceof HTMLSelectElement||i.target.closest?.(".own-keys")||i.ctrlKey||i.metaKey||i.altKey}function zh(i){addEventListener("keydown",t=>{let e=i[t.key];!e||ip(t)||(t.preventDefault(),e(t))})}function kh(i){let t=i<.1;return[{key:"force",name:"Force",unit:"N",scale:1,digits:2},{key:"torque",name:"Torque",unit:t?"mNm":"Nm",scale:t?1e3:1,digits:t?2:3},{key:"depth",name:"Depth inside",unit:"mm",scale:1e3,digits:3,hint:"Of the deepest sample point of the god object. Red: inside. Negative: the nearest point is so far away."},{key:"stretch",name:"Hand to god object",unit:"mm",scale:1e3,digits:2,hint:"Distance of the centres of mass: the stretch of the spring."},{key:"contacts",name:"Contacts",unit:"",scale:1,digits:0,stepped:!0},{key:"time",name:"Computing time",unit:"µs",scale:1e6,digits:1,logarithmic:!0,hint:"Time of all steps of a cycle on the machine that computed it."}]}var F1={free:"nothing holds the god object",contact:"the surface holds the god object",cut:"the motion continues in the next cycle",start_inside:"began inside and is moving out",overflow:"more near points than there is room for",infeasible:"not all gaps can be reached at once",bad_input:"the pose was invalid: held without force"};function H0(i){return F1[i]??i}var Vo=class{constructor(){this.listeners=[],this.system=matchMedia("(prefers-color-scheme: dark)"),this.system.addEventListener("change",()=>this.chosen===void 0&&this.apply()),this.apply()}get dark(){return this.chosen??this.system.matches}onChange(t){this.listeners.push(t)}toggle(){this.chosen=!this.dark,this.apply()}apply(){document.documentElement.dataset.theme=this.dark?"dark":"light";for(let t of this.listeners)t()}colour(t){return getComputedStyle(document.documentElement).getPropertyValue(t).trim()}},ds=["#3b82f6","#a855f7","#0d9488"];var ml=class{constructor(t,e){this.state=mt("span",{className:"state"}),this.words=mt("span",{className:"words"}),this.root=mt("div",{className:"label"},mt("span",{className:"name"},t),this.state,this.words),this.root.style.setProperty("--colour",e)}show(t){this.root.dataset.status!==t&&(this.root.dataset.status=t,this.state.textContent=t,this.state.style.setProperty("--state",`var(--${t.replace("_","-")})`),this.words.textContent=H0(t))}},Vh=class{constructor(t){this.data=t,this.items=t.replays.map(({name:e},n)=>new ml(`replay ${e}`,ds[n])),this.root=mt("div",{className:"labels"},...this.items.map(({root:e})=>e))}place(t){t.forEach(({left:e,top:n,width:s},r)=>{let{style:o}=this.items[r].root;Object.assign(o,{left:`${e+8}px`,top:`${n+8}px`,maxWidth:`${s-16}px`})})}show(t){this.items.forEach((e,n)=>e.show(this.data.statuses[this.data.replays[n].status[t]]))}};function Gh(i,t,e){let n=(r,o=r)=>mt("span",{className:`key ${r.replace(" ","-")}`},o),s=+(1e3*t).toPrecision(3);return mt("div",{className:"keys"},...["hand",...e,"force","torque",...i.workspace?["workspace"]:[]].map(r=>n(r)),n("grid",`grid ${s} mm`))}var W0={type:"change"},rp={type:"start"},q0={type:"end"},Hh=new os,X0=new An,O1=Math.cos(70*Fd.DEG2RAD),In=new U,fi=2*Math.PI,Te={NONE:-1,ROTATE:0,DOLLY:1,PAN:2,TOUCH_ROTATE:3,TOUCH_PAN:4,TOUCH_DOLLY_PAN:5,TOUCH_DOLLY_ROTATE:6},sp=1e-6,Wh=class extends nl{constructor(t,e=null){super(t,e),this.state=Te.NONE,this.target=new U,this.cursor=new U,this.minDistance=0,this.maxDistance=1/0,this.minZoom=0,this.maxZoom=1/0,this.minTargetRadius=0,this.maxTargetRadius=1/0,this.minPolarAngle=0,this.maxPolarAngle=Math.PI,this.minAzimuthAngle=-1/0,this.maxAzimuthAngle=1/0,this.enableDamping=!1,this.dampingFactor=.05,this.enableZoom=!0,this.zoomSpeed=1,this.enableRotate=!0,this.rotateSpeed=1,this.keyRotateSpeed=1,this.enablePan=!0,this.panSpeed=1,this.screenSpacePanning=!0,this.keyPanSpeed=7,this.zoomToCursor=!1,this.autoRotate=!1,this.autoRotateSpeed=2,this.keys={LEFT:"ArrowLeft",UP:"ArrowUp",RIGHT:"ArrowRight",BOTTOM:"ArrowDown"},this.mouseButtons={LEFT:ir.ROTATE,MIDDLE:ir.DOLLY,RIGHT:ir.PAN},this.touches={ONE:sr.ROTATE,TWO:sr.DOLLY_PAN},this.target0=this.target.clone(),this.position0=this.object.position.clone(),this.zoom0=this.object.zoom,this._cursorStyle="auto",this._domElementKeyEvents=null,this._lastPosition=new U,this._lastQuaternion=new en,this._lastTargetPosition=new U,this._quat=new en().setFromUnitVectors(t.up,new U(0,1,0)),this._quatInverse=this._quat.clone().invert(),this._spherical=new Io,this._sphericalDelta=new Io,this._scale=1,this._panOffset=new U,this._rotateStart=new kt,this._rotateEnd=new kt,this._rotateDelta=new kt,this._panStart=new kt,this._panEnd=new kt,this._panDelta=new kt,this._dollyStart=new kt,this._dollyEnd=new kt,this._dollyDelta=new kt,this._dollyDirection=new U,this._mouse=new kt,this._performCursorZoom=!1,this._pointers=[],this._pointerPositions={},this._controlActive=!1,this._onPointerMove=z1.bind(this),this._onPointerDown=B1.bind(this),this._onPointerUp=k1.bind(this),this._onContextMenu=Y1.bind(this),this._onMouseWheel=H1.bind(this),this._onKeyDown=W1.bind(this),this._onTouchStart=X1.bind(this),this._onTouchMove=q1.bind(this),this._onMouseDown=V1.bind(this),this._onMouseMove=G1.bind(this),this._interceptControlDown=Z1.bind(this),this._interceptControlUp=$1.bind(this),this.domElement!==null&&this.connect(this.domElement),this.update()}set cursorStyle(t){this._cursorStyle=t,t==="grab"?this.domElement.style.cursor="grab":this.domElement.style.cursor="auto"}get cursorStyle(){return this._cursorStyle}connect(t){super.connect(t),this.domElement.addEventListener("pointerdown",this._onPointerDown),this.domElement.addEventListener("pointercancel",this._onPointerUp),this.domElement.addEventListener("contextmenu",this._onContextMenu),this.domElement.addEventListener("wheel",this._onMouseWheel,{passive:!1}),this.domElement.ownerDocument.addEventListener("keydown",this._interceptControlDown,{passive:!0,capture:!0}),this.domElement.style.touchAction="none"}disconnect(){this.state=Te.NONE,this.domElement.removeEventListener("pointerdown",this._onPointerDown),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.domElement.removeEventListener("pointercancel",this._onPointerUp),this.domElement.removeEventListener("wheel",this._onMouseWheel),this.domElement.removeEventListener("contextmenu",this._onContextMenu),this.stopListenToKeyEvents(),this.domElement.ownerDocument.removeEventListener("keydown",this._interceptControlDown,{capture:!0}),this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{capture:!0}),this._controlActive=!1,this._pointers.length=0,this._pointerPositions={},this.domElement.style.touchAction="",this.domElement.style.cursor="auto"}dispose(){this.disconnect()}getPolarAngle(){return this._spherical.phi}getAzimuthalAngle(){return this._spherical.theta}getDistance(){return this.object.position.distanceTo(this.target)}listenToKeyEvents(t){t.addEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=t}stopListenToKeyEvents(){this._domElementKeyEvents!==null&&(this._domElementKeyEvents.removeEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=null)}saveState(){this.target0.copy(this.target),this.position0.copy(this.object.position),this.zoom0=this.object.zoom}reset(){this.target.copy(this.target0),this.object.position.copy(this.position0),this.object.zoom=this.zoom0,this.object.updateProjectionMatrix(),this.dispatchEvent(W0),this.update(),this.state=Te.NONE}pan(t,e){this._pan(t,e),this.update()}dollyIn(t){this._dollyIn(t),this.update()}dollyOut(t){this._dollyOut(t),this.update()}rotateLeft(t){this._rotateLeft(t),this.update()}rotateUp(t){this._rotateUp(t),this.update()}update(t=null){let e=this.object.position;In.copy(e).sub(this.target),In.applyQuaternion(this._quat),this._spherical.setFromVector3(In),this.autoRotate&&this.state===Te.NONE&&this._rotateLeft(this._getAutoRotationAngle(t)),this.enableDamping?(this._spherical.theta+=this._sphericalDelta.theta*this.dampingFactor,this._spherical.phi+=this._sphericalDelta.phi*this.dampingFactor):(this._spherical.theta+=this._sphericalDelta.theta,this._spherical.phi+=this._sphericalDelta.phi);let n=this.minAzimuthAngle,s=this.maxAzimuthAngle;isFinite(n)&&isFinite(s)&&(n<-Math.PI?n+=fi:n>Math.PI&&(n-=fi),s<-Math.PI?s+=fi:s>Math.PI&&(s-=fi),n<=s?this._spherical.theta=Math.max(n,Math.min(s,this._spherical.theta)):this._spherical.theta=this._spherical.theta>(n+s)/2?Math.max(n,this._spherical.theta):Math.min(s,this._spherical.theta)),this._spherical.phi=Math.max(this.minPolarAngle,Math.min(this.maxPolarAngle,this._spherical.phi)),this._spherical.makeSafe(),this.enableDamping===!0?this.target.addScaledVector(this._panOffset,this.dampingFactor):this.target.add(this._panOffset),this.target.sub(this.cursor),this.target.clampLength(this.minTargetRadius,this.maxTargetRadius),this.target.add(this.cursor);let r=!1;if(this.zoomToCursor&&this._performCursorZoom||this.object.isOrthographicCamera)this._spherical.radius=this._clampDistance(this._spherical.radius);else{let o=this._spherical.radius;this._spherical.radius=this._clampDistance(this._spherical.radius*this._scale),r=o!=this._spherical.radius}if(In.setFromSpherical(this._spherical),In.applyQuaternion(this._quatInverse),e.copy(this.target).add(In),this.object.lookAt(this.target),this.enableDamping===!0?(this._sphericalDelta.theta*=1-this.dampingFactor,this._sphericalDelta.phi*=1-this.dampingFactor,this._panOffset.multiplyScalar(1-this.dampingFactor)):(this._sphericalDelta.set(0,0,0),this._panOffset.set(0,0,0)),this.zoomToCursor&&this._performCursorZoom){let o=null;if(this.object.isPerspectiveCamera){let a=In.length();o=this._clampDistance(a*this._scale);let l=a-o;this.object.position.addScaledVector(this._dollyDirection,l),this.object.updateMatrixWorld(),r=!!l}else if(this.object.isOrthographicCamera){let a=new U(this._mouse.x,this._mouse.y,0);a.unproject(this.object);let l=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),this.object.updateProjectionMatrix(),r=l!==this.object.zoom;let c=new U(this._mouse.x,this._mouse.y,0);c.unproject(this.object),this.object.position.sub(c).add(a),this.object.updateMatrixWorld(),o=In.length()}else console.warn("WARNING: OrbitControls.js encountered an unknown camera type - zoom to cursor disabled."),this.zoomToCursor=!1;o!==null&&(this.screenSpacePanning?this.target.set(0,0,-1).transformDirection(this.object.matrix).multiplyScalar(o).add(this.object.position):(Hh.origin.copy(this.object.position),Hh.direction.set(0,0,-1).transformDirection(this.object.matrix),Math.abs(this.object.up.dot(Hh.direction))<O1?this.object.lookAt(this.target):(X0.setFromNormalAndCoplanarPoint(this.object.up,this.target),Hh.intersectPlane(X0,this.target))))}else if(this.object.isOrthographicCamera){let o=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),o!==this.object.zoom&&(this.object.updateProjectionMatrix(),r=!0)}return this._scale=1,this._performCursorZoom=!1,r||this._lastPosition.distanceToSquared(this.object.position)>sp||8*(1-this._lastQuaternion.dot(this.object.quaternion))>sp||this._lastTargetPosition.distanceToSquared(this.target)>sp?(this.dispatchEvent(W0),this._lastPosition.copy(this.object.position),this._lastQuaternion.copy(this.object.quaternion),this._lastTargetPosition.copy(this.target),!0):!1}_getAutoRotationAngle(t){return t!==null?fi/60*this.autoRotateSpeed*t:fi/60/60*this.autoRotateSpeed}_getZoomScale(t){let e=Math.abs(t*.01);return Math.pow(.95,this.zoomSpeed*e)}_rotateLeft(t){this._sphericalDelta.theta-=t}_rotateUp(t){this._sphericalDelta.phi-=t}_panLeft(t,e){In.setFromMatrixColumn(e,0),In.multiplyScalar(-t),this._panOffset.add(In)}_panUp(t,e){this.screenSpacePanning===!0?In.setFromMatrixColumn(e,1):(In.setFromMatrixColumn(e,0),In.crossVectors(this.object.up,In)),In.multiplyScalar(t),this._panOffset.add(In)}_pan(t,e){let n=this.domElement;if(this.object.isPerspectiveCamera){let s=this.object.position;In.copy(s).sub(this.target);let r=In.length();r*=Math.tan(this.object.fov/2*Math.PI/180),this._panLeft(2*t*r/n.clientHeight,this.object.matrix),this._panUp(2*e*r/n.clientHeight,this.object.matrix)}else this.object.isOrthographicCamera?(this._panLeft(t*(this.object.right-this.object.left)/this.object.zoom/n.clientWidth,this.object.matrix),this._panUp(e*(this.object.top-this.object.bottom)/this.object.zoom/n.clientHeight,this.object.matrix)):(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - pan disabled."),this.enablePan=!1)}_dollyOut(t){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale/=t:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_dollyIn(t){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale*=t:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_updateZoomParameters(t,e){if(!this.zoomToCursor)return;this._performCursorZoom=!0;let n=this.domElement.getBoundingClientRect(),s=t-n.left,r=e-n.top,o=n.width,a=n.height;this._mouse.x=s/o*2-1,this._mouse.y=-(r/a)*2+1,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()}_clampDistance(t){return Math.max(this.minDistance,Math.min(this.maxDistance,t))}_handleMouseDownRotate(t){this._rotateStart.set(t.clientX,t.clientY)}_handleMouseDownDolly(t){this._updateZoomParameters(t.clientX,t.clientY),this._dollyStart.set(t.clientX,t.clientY)}_handleMouseDownPan(t){this._panStart.set(t.clientX,t.clientY)}_handleMouseMoveRotate(t){this._rotateEnd.set(t.clientX,t.clientY),this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let e=this.domElement;this._rotateLeft(fi*this._rotateDelta.x/e.clientHeight),this._rotateUp(fi*this._rotateDelta.y/e.clientHeight),this._rotateStart.copy(this._rotateEnd),this.update()}_handleMouseMoveDolly(t){this._dollyEnd.set(t.clientX,t.clientY),this._dollyDelta.subVectors(this._dollyEnd,this._dollyStart),this._dollyDelta.y>0?this._dollyOut(this._getZoomScale(this._dollyDelta.y)):this._dollyDelta.y<0&&this._dollyIn(this._getZoomScale(this._dollyDelta.y)),this._dollyStart.copy(this._dollyEnd),this.zoomToCursor&&(this._performCursorZoom=!0,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()),this.update()}_handleMouseMovePan(t){this._panEnd.set(t.clientX,t.clientY),this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd),this.update()}_handleMouseWheel(t){this._updateZoomParameters(t.clientX,t.clientY),t.deltaY<0?this._dollyIn(this._getZoomScale(t.deltaY)):t.deltaY>0&&this._dollyOut(this._getZoomScale(t.deltaY)),this.update()}_handleKeyDown(t){let e=!1;switch(t.code){case this.keys.UP:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateUp(fi*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,this.keyPanSpeed),e=!0;break;case this.keys.BOTTOM:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateUp(-fi*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,-this.keyPanSpeed),e=!0;break;case this.keys.LEFT:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateLeft(fi*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(this.keyPanSpeed,0),e=!0;break;case this.keys.RIGHT:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateLeft(-fi*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(-this.keyPanSpeed,0),e=!0;break}e&&(t.preventDefault(),this.update())}_handleTouchStartRotate(t){if(this._pointers.length===1)this._rotateStart.set(t.pageX,t.pageY);else{let e=this._getSecondPointerPosition(t),n=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._rotateStart.set(n,s)}}_handleTouchStartPan(t){if(this._pointers.length===1)this._panStart.set(t.pageX,t.pageY);else{let e=this._getSecondPointerPosition(t),n=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._panStart.set(n,s)}}_handleTouchStartDolly(t){let e=this._getSecondPointerPosition(t),n=t.pageX-e.x,s=t.pageY-e.y,r=Math.sqrt(n*n+s*s);this._dollyStart.set(0,r)}_handleTouchStartDollyPan(t){this.enableZoom&&this._handleTouchStartDolly(t),this.enablePan&&this._handleTouchStartPan(t)}_handleTouchStartDollyRotate(t){this.enableZoom&&this._handleTouchStartDolly(t),this.enableRotate&&this._handleTouchStartRotate(t)}_handleTouchMoveRotate(t){if(this._pointers.length==1)this._rotateEnd.set(t.pageX,t.pageY);else{let n=this._getSecondPointerPosition(t),s=.5*(t.pageX+n.x),r=.5*(t.pageY+n.y);this._rotateEnd.set(s,r)}this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let e=this.domElement;this._rotateLeft(fi*this._rotateDelta.x/e.clientHeight),this._rotateUp(fi*this._rotateDelta.y/e.clientHeight),this._rotateStart.copy(this._rotateEnd)}_handleTouchMovePan(t){if(this._pointers.length===1)this._panEnd.set(t.pageX,t.pageY);else{let e=this._getSecondPointerPosition(t),n=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._panEnd.set(n,s)}this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd)}_handleTouchMoveDolly(t){let e=this._getSecondPointerPosition(t),n=t.pageX-e.x,s=t.pageY-e.y,r=Math.sqrt(n*n+s*s);this._dollyEnd.set(0,r),this._dollyDelta.set(0,Math.pow(this._dollyEnd.y/this._dollyStart.y,this.zoomSpeed)),this._dollyOut(this._dollyDelta.y),this._dollyStart.copy(this._dollyEnd);let o=(t.pageX+e.x)*.5,a=(t.pageY+e.y)*.5;this._updateZoomParameters(o,a)}_handleTouchMoveDollyPan(t){this.enableZoom&&this._handleTouchMoveDolly(t),this.enablePan&&this._handleTouchMovePan(t)}_handleTouchMoveDollyRotate(t){this.enableZoom&&this._handleTouchMoveDolly(t),this.enableRotate&&this._handleTouchMoveRotate(t)}_addPointer(t){this._pointers.push(t.pointerId)}_removePointer(t){delete this._pointerPositions[t.pointerId];for(let e=0;e<this._pointers.length;e++)if(this._pointers[e]==t.pointerId){this._pointers.splice(e,1);return}}_isTrackingPointer(t){for(let e=0;e<this._pointers.length;e++)if(this._pointers[e]==t.pointerId)return!0;return!1}_trackPointer(t){let e=this._pointerPositions[t.pointerId];e===void 0&&(e=new kt,this._pointerPositions[t.pointerId]=e),e.set(t.pageX,t.pageY)}_getSecondPointerPosition(t){let e=t.pointerId===this._pointers[0]?this._pointers[1]:this._pointers[0];return this._pointerPositions[e]}_customWheelEvent(t){let e=t.deltaMode,n={clientX:t.clientX,clientY:t.clientY,deltaY:t.deltaY};switch(e){case 1:n.deltaY*=16;break;case 2:n.deltaY*=100;break}return t.ctrlKey&&!this._controlActive&&(n.deltaY*=10),n}};function B1(i){this.enabled!==!1&&(this._pointers.length===0&&(this.domElement.setPointerCapture(i.pointerId),this.domElement.ownerDocument.addEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.addEventListener("pointerup",this._onPointerUp)),!this._isTrackingPointer(i)&&(this._addPointer(i),i.pointerType==="touch"?this._onTouchStart(i):this._onMouseDown(i),this._cursorStyle==="grab"&&(this.domElement.style.cursor="grabbing")))}function z1(i){this.enabled!==!1&&(i.pointerType==="touch"?this._onTouchMove(i):this._onMouseMove(i))}function k1(i){switch(this._removePointer(i),this._pointers.length){case 0:this.domElement.releasePointerCapture(i.pointerId),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.dispatchEvent(q0),this.state=Te.NONE,this._cursorStyle==="grab"&&(this.domElement.style.cursor="grab");break;case 1:let t=this._pointers[0],e=this._pointerPositions[t];this._onTouchStart({pointerId:t,pageX:e.x,pageY:e.y});break}}function V1(i){let t;switch(i.button){case 0:t=this.mouseButtons.LEFT;break;case 1:t=this.mouseButtons.MIDDLE;break;case 2:t=this.mouseButtons.RIGHT;break;default:t=-1}switch(t){case ir.DOLLY:if(this.enableZoom===!1)return;this._handleMouseDownDolly(i),this.state=Te.DOLLY;break;case ir.ROTATE:if(i.ctrlKey||i.metaKey||i.shiftKey){if(this.enablePan===!1)return;this._handleMouseDownPan(i),this.state=Te.PAN}else{if(this.enableRotate===!1)return;this._handleMouseDownRotate(i),this.state=Te.ROTATE}break;case ir.PAN:if(i.ctrlKey||i.metaKey||i.shiftKey){if(this.enableRotate===!1)return;this._handleMouseDownRotate(i),this.state=Te.ROTATE}else{if(this.enablePan===!1)return;this._handleMouseDownPan(i),this.state=Te.PAN}break;default:this.state=Te.NONE}this.state!==Te.NONE&&this.dispatchEvent(rp)}function G1(i){switch(this.state){case Te.ROTATE:if(this.enableRotate===!1)return;this._handleMouseMoveRotate(i);break;case Te.DOLLY:if(this.enableZoom===!1)return;this._handleMouseMoveDolly(i);break;case Te.PAN:if(this.enablePan===!1)return;this._handleMouseMovePan(i);break}}function H1(i){this.enabled===!1||this.enableZoom===!1||this.state!==Te.NONE||(i.preventDefault(),this.dispatchEvent(rp),this._handleMouseWheel(this._customWheelEvent(i)),this.dispatchEvent(q0))}function W1(i){this.enabled!==!1&&this._handleKeyDown(i)}function X1(i){switch(this._trackPointer(i),this._pointers.length){case 1:switch(this.touches.ONE){case sr.ROTATE:if(this.enableRotate===!1){this.state=Te.NONE;break}this._handleTouchStartRotate(i),this.state=Te.TOUCH_ROTATE;break;case sr.PAN:if(this.enablePan===!1){this.state=Te.NONE;break}this._handleTouchStartPan(i),this.state=Te.TOUCH_PAN;break;default:this.state=Te.NONE}break;case 2:switch(this.touches.TWO){case sr.DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchStartDollyPan(i),this.state=Te.TOUCH_DOLLY_PAN;break;case sr.DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchStartDollyRotate(i),this.state=Te.TOUCH_DOLLY_ROTATE;break;default:this.state=Te.NONE}break;default:this.state=Te.NONE}this.state!==Te.NONE&&this.dispatchEvent(rp)}function q1(i){switch(this._trackPointer(i),this.state){case Te.TOUCH_ROTATE:if(this.enableRotate===!1)return;this._handleTouchMoveRotate(i),this.update();break;case Te.TOUCH_PAN:if(this.enablePan===!1)return;this._handleTouchMovePan(i),this.update();break;case Te.TOUCH_DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchMoveDollyPan(i),this.update();break;case Te.TOUCH_DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchMoveDollyRotate(i),this.update();break;default:this.state=Te.NONE}}function Y1(i){this.enabled!==!1&&i.preventDefault()}function Z1(i){i.key==="Control"&&(this._controlActive=!0,this.domElement.ownerDocument.addEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}function $1(i){i.key==="Control"&&(this._controlActive=!1,this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}var Y0=new U(0,1,0),Z0=1.2;function $0(i,t){return new ri({color:i,depthTest:!1,depthWrite:!1,transparent:!0,opacity:t})}function Xh(i,t){let e=new En(i,t);return e.renderOrder=20,e.frustumCulled=!1,e}function K0(i,t,e){i.visible=e>0,i.visible&&i.quaternion.copy(new en().setFromUnitVectors(Y0,t.clone().normalize()))}var qh=class extends dn{constructor(t,e,n){super(),this.longest=e,this.largest=n;let s=$0(t,1);this.shaft=Xh(new Gi(1,1,1,16).translate(0,.5,0),s),this.head=Xh(new Qs(1,1,24).translate(0,.5,0),s),this.add(this.shaft,this.head)}show(t,e){let n=e.length(),s=n>.001*this.largest?Math.min(Math.max(n/this.largest,.12),Z0)*this.longest:0;K0(this,e,s),this.position.copy(t);let r=Math.min(.2*this.longest,.6*s);this.shaft.scale.set(.02*this.longest,s-.9*r,.02*this.longest),this.head.scale.set(.36*r,r,.36*r),this.head.position.y=s-r}},Yh=class extends dn{constructor(t,e,n){super(),this.radius=e,this.largest=n;let s=$0(t,1),r=1.5*Math.PI,o=Xh(new Ya(1,.055,10,64,r).rotateX(-Math.PI/2),s),a=Xh(new Qs(.17,.46,20).translate(0,.1,0),s);a.position.set(Math.cos(r),0,-Math.sin(r)),a.quaternion.setFromUnitVectors(Y0,new U(-Math.sin(r),0,-Math.cos(r))),this.add(o,a)}show(t,e){let n=e.length(),s=n>.001*this.largest?Math.min(Math.max(n/this.largest,.25),Z0)*this.radius:0;K0(this,e,s),this.position.copy(t),this.scale.setScalar(Math.max(s,1e-9))}};var K1=13222838,J1=16096779,ar={hiddenGhost:1,cutFace:1.5,godObject:2,ghostDepth:3,ghost:4},j0=128;function Q0(i,t){return{material:new cs({color:i,roughness:.62,metalness:.02,side:$n,polygonOffset:!0,polygonOffsetFactor:1,polygonOffsetUnits:1,transparent:t>0}),renderOrder:t}}function Go(i,{material:t,renderOrder:e}){let n=new En(i,t);return n.renderOrder=e,n}function op(i,t,e,n){let s=new as({color:t,transparent:!0,opacity:e}),r=new Tr(i,s);return r.renderOrder=n,r}var Zh=class extends dn{constructor(t,e,n,s){super(),this.surface=Go(t.surface,Q0(K1,0)),this.edges=op(t.edges,4933180,.35,.5),this.add(this.surface,this.edges),this.cut=n,e&&(this.closing=n.closing(t.surface,14262908,s,.1),this.add(this.closing.counted,this.closing.cap))}refresh(){let t=this.cut.planesFor(!1);for(let e of[this.surface,this.edges])e.material.clippingPlanes=t;this.closing&&(this.closing.counted.visible=this.closing.cap.visible=t.length>0)}};function J0(i,[t,e,n,s,r,o,a]){i.position.set(t,e,n),i.quaternion.set(r,o,a,s).normalize()}function j1(i,t,e){return i.position.distanceTo(t.position)<e&&i.quaternion.angleTo(t.quaternion)<1e-4}function Q1(i){return i.onBeforeCompile=t=>{t.fragmentShader=t.fragmentShader.replace("#include <opaque_fragment>",`
      float facing = abs(dot(normalize(vViewPosition), normal));
      diffuseColor.a *= mix(1.0, 0.24, smoothstep(0.0, 0.75, facing));
      #include <opaque_fragment>`)},i}function tT(i){let t=new dn,e=new $t(J1),n=new ri({color:e,transparent:!0,opacity:.16,depthFunc:vo,depthWrite:!1,stencilWrite:!0,stencilRef:255,stencilFunc:Oo,stencilZPass:or}),s=Go(i.surface,{material:n,renderOrder:ar.hiddenGhost});s.onAfterRender=a=>a.clearStencil();let r=new ri({colorWrite:!1,transparent:!0}),o=[[Oo,.85],[Ed,.4]].map(([a,l])=>Q1(new cs({color:e,transparent:!0,opacity:l,roughness:.7,depthFunc:Js,depthWrite:!1,stencilWrite:!0,stencilRef:j0,stencilFunc:a})));return t.surface=Go(i.surface,{material:r,renderOrder:ar.ghostDepth}),t.lit=o,t.add(s,t.surface,...o.map(a=>Go(i.surface,{material:a,renderOrder:ar.ghost})),op(i.edges,14251782,.9,ar.ghost)),t}var $h=class extends dn{constructor(t,e,n,s,r,o){if(super(),this.centre=new U(...t.centre),this.cut=s,this.size=r.length,this.godObject=new dn,this.surface=Go(e.surface,Q0(n,ar.godObject)),Object.assign(this.surface.material,{stencilWrite:!0,stencilRef:j0,stencilZPass:or}),this.surfaces=[this.surface],this.edges=op(e.edges,new $t(n).multiplyScalar(.35),.6,ar.godObject+.2),this.godObject.add(this.surface,this.edges),t.closed){this.closing=s.closing(e.surface,new $t(n).multiplyScalar(.6),o,ar.cutFace);for(let a of[...this.closing.counted.children,this.closing.cap])a.material.transparent=!0;this.godObject.add(this.closing.counted),this.add(this.closing.cap)}this.ghost=tT(e),this.force=new qh(14753096,r.length,r.force),this.torque=new Yh(1483594,r.radius,r.torque),this.add(this.godObject,this.ghost,this.force,this.torque)}addColoured(t,e){this.coloured=Go(t,{material:this.surface.material.clone(),renderOrder:ar.godObject}),e(this.coloured.material),this.surfaces.push(this.coloured),this.godObject.add(this.coloured),this.refresh()}showColoured(t){this.surface.visible=!t,this.ghost.lit[1].visible=!t,this.coloured&&(this.coloured.visible=t)}place(){return this.centre.clone().applyQuaternion(this.godObject.quaternion).add(this.godObject.position)}show({device:t,god:e,force:n,torque:s}){J0(this.godObject,e),J0(this.ghost,t),this.ghost.visible=!j1(this.ghost,this.godObject,1e-4*this.size);let r=this.centre.clone().applyQuaternion(this.ghost.quaternion).add(this.ghost.position);this.force.show(r,new U(...n)),this.torque.show(r,new U(...s))}highlight(t){for(let{emissive:e}of[...this.surfaces.map(({material:n})=>n),...this.ghost.lit])e.setScalar(t?.09:0)}refresh(){let t=this.cut.planesFor(!0);for(let e of[...this.surfaces,this.edges])e.material.clippingPlanes=t;for(let e of this.ghost.children)e.material.clippingPlanes=t;this.ghost.children[0].visible=!this.cut.on,this.closing&&(this.closing.counted.visible=this.closing.cap.visible=t.length>0)}};var eT=Math.cos(.6);function gl(i){let t=i.vertices[0].length,e=new Float32Array(3*t);for(let n=0;n<3;++n)for(let s=0;s<t;++s)e[3*s+n]=i.low[n]+i.vertices[n][s];return e}function ap(i,t){let e=new Float64Array(t.length);for(let n=0;n<t.length;n+=3){let[s,r,o]=[3*t[n],3*t[n+1],3*t[n+2]],a=[0,1,2].map(c=>i[r+c]-i[s+c]),l=[0,1,2].map(c=>i[o+c]-i[s+c]);e[n]=a[1]*l[2]-a[2]*l[1],e[n+1]=a[2]*l[0]-a[0]*l[2],e[n+2]=a[0]*l[1]-a[1]*l[0]}return e}function t_(i,t,e){let n=i[t]*i[e]+i[t+1]*i[e+1]+i[t+2]*i[e+2],s=Math.hypot(i[t],i[t+1],i[t+2])*Math.hypot(i[e],i[e+1],i[e+2]);return n>=eT*s}function lp(i,t){let e=Array.from({length:i},()=>[]);return t.forEach((n,s)=>e[n].push(s-s%3)),e}function nT(i,t,e){let n=lp(i.length/3,t),s=new Float32Array(3*t.length),r=new Float32Array(3*t.length);t.forEach((a,l)=>{let c=l-l%3,f=[0,0,0];for(let h of n[a])if(h===c||t_(e,c,h))for(let d=0;d<3;++d)f[d]+=e[h+d];let u=Math.hypot(...f)||1;for(let h=0;h<3;++h)s[3*l+h]=i[3*a+h],r[3*l+h]=f[h]/u});let o=new pn;return o.setAttribute("position",new Je(s,3)),o.setAttribute("normal",new Je(r,3)),o}function iT(i,t,e,n){let s=(o,a)=>Math.hypot(...[0,1,2].map(l=>i[3*o+l]-i[3*a+l])),r=new Set;for(let o=0;o<t.length;o+=3){let[a,l,c]=t.subarray(o,o+3),f=Math.max(s(a,l),s(l,c),s(c,a));Math.hypot(e[o],e[o+1],e[o+2])<4*n*f&&r.add(o)}return r}function sT(i,t,e,n){let s=i.length/3,r=iT(i,t,e,n),o=new Map;for(let c=0;c<t.length;++c){let f=c-c%3,u=t[c],h=t[c%3===2?c-2:c+1],d=u<h?u*s+h:h*s+u,g=o.get(d);g!==void 0&&(r.has(f)||r.has(g)||t_(e,g,f))?o.delete(d):o.set(d,f)}let a=[];for(let c of o.keys())for(let f of[Math.floor(c/s),c%s])a.push(i[3*f],i[3*f+1],i[3*f+2]);let l=new pn;return l.setAttribute("position",new Je(new Float32Array(a),3)),l}function cp(i){let t=gl(i),e=ap(t,i.triangles),n=Math.max(...i.high.map((s,r)=>s-i.low[r]))/65535;return{surface:nT(t,i.triangles,e),edges:sT(t,i.triangles,e,n)}}var Kh=class{constructor(){this.plane=new An(new U(0,0,-1),0),this.caps=[],this.on=!1,this.both=!1}place(t,e,n){let s=new U().setComponent(t,n.getComponent(t)>0?-1:1);this.plane.setFromNormalAndCoplanarPoint(s,new U().setComponent(t,e));for(let r of this.caps)r.position.copy(this.plane.normal).multiplyScalar(-this.plane.constant),r.lookAt(r.position.clone().sub(this.plane.normal))}planesFor(t){return this.on&&(this.both||!t)?[this.plane]:[]}closing(t,e,n,s){let r=new dn;for(let[a,l]of[[Cn,Td],[Mi,Ad]]){let c=new ri({side:a,depthWrite:!1,depthTest:!1,colorWrite:!1,stencilWrite:!0,stencilFunc:Ih,clippingPlanes:[this.plane],stencilFail:l,stencilZFail:l,stencilZPass:l}),f=new En(t,c);f.renderOrder=s,r.add(f)}let o=new En(new Ar(n,n),new cs({color:e,roughness:1,side:$n,stencilWrite:!0,stencilRef:0,stencilFunc:Oo,stencilFail:or,stencilZFail:or,stencilZPass:or}));return o.renderOrder=s+.1,o.onAfterRender=a=>a.clearStencil(),this.caps.push(o),{counted:r,cap:o}}};var rT=[1,2,5];function hp(i){let t=10**Math.floor(Math.log10(i));return t*rT.filter(e=>e*t<=i*1.0001).at(-1)}var Jh=class{constructor(t,e,n){if(this.scene=new Ba,this.sky=new Ka(16777215,9078136,1.25),this.key=new Ro(16777215,2),this.fill=new Ro(14674175,.6),this.scene.add(this.sky,this.key,this.key.target,this.fill,this.fill.target),this.gridStep=hp(.2*e),this.size=e,this.floor=s=>Math.max(n(s),t.still.low[s]-e),t.workspace){let s=new Oe(new U(...t.workspace.low),new U(...t.workspace.high));this.workspace=new el(s,16096779),this.scene.add(this.workspace)}}setGround(t,e,n){this.grid&&(this.scene.remove(this.grid),this.grid.dispose());let s=24;this.grid=new tl(s*this.gridStep,s);let r=new $t(n?3817808:12830928);this.grid.material.vertexColors=!1,this.grid.material.color=r,this.grid.material.transparent=!0,this.grid.material.opacity=n?.7:.8;let o=new U().setComponent(t,1);this.grid.quaternion.setFromUnitVectors(new U(0,1,0),o);let a=e.clone();for(let l=0;l<3;++l)a.setComponent(l,Math.round(a.getComponent(l)/this.gridStep)*this.gridStep);this.grid.position.copy(a.setComponent(t,this.floor(t)-.002*this.size)),this.scene.add(this.grid)}light(t,e,n){let s=new U(1,0,0).applyQuaternion(t.quaternion),r=new U().setComponent(n,1),o=t.position.clone().sub(e),a=o.length();this.key.position.copy(t.position).addScaledVector(s,-.5*a),this.key.position.addScaledVector(r,.9*a),this.key.target.position.copy(e),this.fill.position.copy(e).addScaledVector(s,a).addScaledVector(o,.2),this.fill.target.position.copy(e)}};var oT=48,aT=6e4,up=class{constructor(t,e){this.points=Array.from(gl(t)),this.vertices=Array.from(t.triangles),this.normals=Array.from(e.getAttribute("normal").array),this.middles=new Map,this.index=[]}length(t,e){let{points:n}=this,[s,r]=[3*this.vertices[t],3*this.vertices[e]],[o,a,l]=[n[s]-n[r],n[s+1]-n[r+1],n[s+2]-n[r+2]];return Math.sqrt(o*o+a*a+l*l)}middleVertex(t,e){let n=Math.min(t,e)*67108864+Math.max(t,e),s=this.middles.get(n);if(s!==void 0)return s;let r=this.points.length/3;for(let o=0;o<3;++o)this.points.push((this.points[3*t+o]+this.points[3*e+o])/2);return this.middles.set(n,r),r}middleCorner(t,e){let{normals:n,vertices:s}=this,r=[0,1,2].map(a=>n[3*t+a]+n[3*e+a]),o=Math.hypot(...r)||1;return n.push(...r.map(a=>a/o)),s.push(this.middleVertex(s[t],s[e]))-1}add(t,e,n,s){let r=[this.length(t,e),this.length(e,n),this.length(n,t)],o=Math.max(...r);if(o<=s)this.index.push(t,e,n);else if(o===r[0]){let a=this.middleCorner(t,e);this.add(t,a,n,s),this.add(a,e,n,s)}else this.add(e,n,t,s)}addAll(t,e){let n=this.vertices.length;for(let s=0;s<n&&this.index.length<=3*e;s+=3)this.add(s,s+1,s+2,t);return this.index.length<=3*e}geometry(){let{points:t,vertices:e}=this,n=new Float32Array(3*e.length);e.forEach((r,o)=>{for(let a=0;a<3;++a)n[3*o+a]=t[3*r+a]});let s=new pn;return s.setAttribute("position",new Je(n,3)),s.setAttribute("normal",new Je(Float32Array.from(this.normals),3)),s.setAttribute("vertex",new Je(Float32Array.from(e),1)),s.setIndex(new Je(Uint32Array.from(this.index),1)),s}};function e_(i,t,e){let n=Math.max(aT,i.triangles.length/3);for(let s=e/oT;;s*=1.5){let r=new up(i,t);if(r.addAll(s,n))return{geometry:r.geometry(),points:Float32Array.from(r.points)}}}var n_=["#fde725","#addc30","#5ec962","#28ae80","#21918c","#2c728e","#3b528b"],Qh="#e5173f",i_=2,jh=class{constructor(t){this.far=t,this.near=t/10**i_,this.colours=n_.map(e=>new $t(e))}share(t){return Math.min(Math.log1p(t/this.near)/Math.log1p(this.far/this.near),1)}ticks(){return[0,...Array.from({length:i_+1},(t,e)=>this.near*10**e)]}gradient(){return`linear-gradient(to right, ${n_.join(", ")})`}};var Ho=Math.pow(2,-24),_l=Symbol("SKIP_GENERATION"),tu={strategy:0,maxDepth:40,targetLeafSize:10,useSharedArrayBuffer:!1,setBoundingBox:!0,onProgress:null,indirect:!1,verbose:!0,range:null,[_l]:!1};function ke(i,t,e){return e.min.x=t[i],e.min.y=t[i+1],e.min.z=t[i+2],e.max.x=t[i+3],e.max.y=t[i+4],e.max.z=t[i+5],e}function xl(i){let t=-1,e=-1/0;for(let n=0;n<3;n++){let s=i[n+3]-i[n];s>e&&(e=s,t=n)}return t}function fp(i,t,e){for(let n=0;n<3;n++){let s=t[i+2*n],r=t[i+2*n+1],o=s-r,a=s+r;o<e[n]&&(e[n]=o),a>e[n+3]&&(e[n+3]=a)}}function eu(i){let t=i[3]-i[0],e=i[4]-i[1],n=i[5]-i[2];return 2*(t*e+e*n+n*t)}function Se(i,t){return t[i+15]===65535}function Pe(i,t){return t[i+6]}function Be(i,t){return t[i+14]}function Ae(i){return i+8}function Ee(i,t){let e=t[i+6];return i+e*8}function Wo(i,t){return t[i+7]}function nu(i,t,e,n,s){let r=1/0,o=1/0,a=1/0,l=-1/0,c=-1/0,f=-1/0,u=1/0,h=1/0,d=1/0,g=-1/0,v=-1/0,m=-1/0,p=i.offset||0;for(let _=(t-p)*6,M=(t+e-p)*6;_<M;_+=6){let y=i[_+0],w=i[_+1],T=y-w,x=y+w;T<r&&(r=T),x>l&&(l=x),y<u&&(u=y),y>g&&(g=y);let b=i[_+2],D=i[_+3],C=b-D,P=b+D;C<o&&(o=C),P>c&&(c=P),b<h&&(h=b),b>v&&(v=b);let I=i[_+4],O=i[_+5],L=I-O,z=I+O;L<a&&(a=L),z>f&&(f=z),I<d&&(d=I),I>m&&(m=I)}n[0]=r,n[1]=o,n[2]=a,n[3]=l,n[4]=c,n[5]=f,s[0]=u,s[1]=h,s[2]=d,s[3]=g,s[4]=v,s[5]=m}var ms=8,pp=8,dp=new Int32Array(ms),ps=new Float32Array(ms*6),Xo=new Float32Array(ms*6),qi=new Float32Array(6),iu=new Float32Array(6),lr=new Int32Array(pp),r_=new Float32Array(pp*6);function hT(i,t,e,n){for(let s=0;s<3;s++){let r=t[i+2*s],o=t[i+2*s+1],a=r-o,l=r+o;a<e[n+s]&&(e[n+s]=a),l>e[n+s+3]&&(e[n+s+3]=l)}}function o_(i,t){let e=i[t+3]-i[t],n=i[t+4]-i[t+1],s=i[t+5]-i[t+2];return 2*(e*n+n*s+s*e)}function a_(i,t,e,n,s,r){let o=-1,a=0;if(r===0)o=xl(t),o!==-1&&(a=(t[o]+t[o+3])/2);else if(r===1)o=xl(i),o!==-1&&(a=uT(e,n,s,o));else if(r===2){let l=eu(i),c=1.25*s,f=e.offset||0,u=(n-f)*6,h=(n+s-f)*6;for(let d=0;d<3;d++){let g=t[d],p=(t[d+3]-g)/ms;if(s<pp){for(let _=0;_<s;_++){let M=u+_*6,y=e[M+2*d],w=_;for(;w>0&&e[lr[w-1]+2*d]>y;)lr[w]=lr[w-1],w--;lr[w]=M}for(let _=0;_<3;_++)qi[_]=1/0,qi[_+3]=-1/0,iu[_]=1/0,iu[_+3]=-1/0;for(let _=s-1;_>=0;_--)fp(lr[_],e,iu),r_.set(iu,_*6);for(let _=0;_<s-1;_++){fp(lr[_],e,qi);let M=e[lr[_+1]+2*d];if(e[lr[_]+2*d]===M)continue;let y=_+1,w=s-y,T=eu(qi)/l,x=o_(r_,y*6)/l,b=1+1.25*(T*y+x*w);b<c&&(o=d,c=b,a=M)}}else{for(let y=0;y<ms;y++){dp[y]=0;for(let w=0;w<3;w++)ps[y*6+w]=1/0,ps[y*6+w+3]=-1/0}for(let y=u;y<h;y+=6){let x=~~((e[y+2*d]-g)/p);x>=ms&&(x=ms-1),dp[x]++,hT(y,e,ps,x*6)}let _=(ms-1)*6;for(let y=0;y<6;y++)Xo[_+y]=ps[_+y];for(let y=ms-2;y>=0;y--){let w=y*6,T=w+6;for(let x=0;x<3;x++)Xo[w+x]=Math.min(ps[w+x],Xo[T+x]),Xo[w+x+3]=Math.max(ps[w+x+3],Xo[T+x+3])}let M=0;for(let y=0;y<ms-1;y++){let w=y*6,T=dp[y];if(T!==0)for(let P=0;P<3;P++)M===0?(qi[P]=ps[w+P],qi[P+3]=ps[w+P+3]):(qi[P]=Math.min(qi[P],ps[w+P]),qi[P+3]=Math.max(qi[P+3],ps[w+P+3]));M+=T;let x=0,b=0;M!==0&&(x=eu(qi)/l);let D=s-M;D!==0&&(b=o_(Xo,w+6)/l);let C=1+1.25*(x*M+b*D);C<c&&(o=d,c=C,a=g+p+y*p)}}}}else console.warn(`BVH: Invalid build strategy value ${r} used.`);return{axis:o,pos:a}}function uT(i,t,e,n){let s=0,r=i.offset;for(let o=t,a=t+e;o<a;o++)s+=i[(o-r)*6+n*2];return s/e}function l_(i,t,e,n,s,r){let o=n,a=n+s-1,l=r.pos,c=r.axis*2,f=e.offset||0;for(;;){for(;o<=a&&e[(o-f)*6+c]<l;)o++;for(;o<=a&&e[(a-f)*6+c]>=l;)a--;if(o<a){for(let u=0;u<t;u++){let h=i[o*t+u];i[o*t+u]=i[a*t+u],i[a*t+u]=h}for(let u=0;u<6;u++){let h=o-f,d=a-f,g=e[h*6+u];e[h*6+u]=e[d*6+u],e[d*6+u]=g}o++,a--}else return o}}var fT=Math.pow(2,32),qo=new Float32Array(6),su=new Float32Array(6);function dT(i,t,e,n,s,r){let{maxDepth:o,verbose:a,targetLeafSize:l,_strictLeafSize:c=1/0,strategy:f,onProgress:u,useSharedArrayBuffer:h=!1}=s,d=i.primitiveBuffer,g=i.primitiveBufferStride,v=h?SharedArrayBuffer:ArrayBuffer,m=new v(32*Math.max(1,2*Math.ceil(n)-1)),p=new Float32Array(m),_=new Uint32Array(m),M=new Uint16Array(m),y=0,w=!1;return nu(t,e,n,qo,su),b(e,n,0),m.slice(0,y*32);function T(D){u&&u((D-r.offset)/r.count)}function x(D,C,P){let I=D*2;_[D+6]=C,M[I+14]=P,M[I+15]=65535,T(C+P)}function b(D,C,P){let I=y++,O=I*8;p.set(qo,O),!w&&P>=o&&(w=!0,a&&console.warn(`BVH: Max depth of ${o} reached when generating BVH. Consider increasing maxDepth.`));let L=C>c;if(C<=l&&!L||P>=o){x(O,D,C);return}let z=a_(qo,su,t,D,C,f),X=z.axis===-1?-1:l_(d,g,t,D,C,z);if(z.axis===-1||X===D||X===D+C){if(!L){x(O,D,C);return}z.axis=Math.max(0,xl(qo)),X=D+Math.max(1,Math.floor(C/2))}_[O+7]=z.axis;let H=X-D;nu(t,D,H,qo,su),b(D,H,P+1);let at=y-I;if(at>fT)throw new Error("MeshBVH: Cannot store relative child node offset greater than 32 bits.");_[O+6]=at;let Z=C-H;nu(t,X,Z,qo,su),b(X,Z,P+1)}}function c_(i,t){let e=i.getRootRanges(t.range),n=e[0],s=e[e.length-1],r={offset:n.offset,count:s.offset+s.count-n.offset},o=new Float32Array(6*r.count);o.offset=r.offset,i.computePrimitiveBounds(r.offset,r.count,o),i._roots=e.map(a=>dT(i,o,a.offset,a.count,t,r))}var cr=class{constructor(t){this._getNewPrimitive=t,this._primitives=[]}getPrimitive(){let t=this._primitives;return t.length===0?this._getNewPrimitive():t.pop()}releasePrimitive(t){this._primitives.push(t)}};var mp=class{constructor(){this.float32Array=null,this.uint16Array=null,this.uint32Array=null;let t=[],e=null;this.setBuffer=n=>{e&&t.push(e),e=n,this.float32Array=new Float32Array(n),this.uint16Array=new Uint16Array(n),this.uint32Array=new Uint32Array(n)},this.clearBuffer=()=>{e=null,this.float32Array=null,this.uint16Array=null,this.uint32Array=null,t.length!==0&&this.setBuffer(t.pop())}}},ge=new mp;var hr,Zo,Yo=[],ru=new cr(()=>new Oe);function h_(i,t,e,n,s,r){hr=ru.getPrimitive(),Zo=ru.getPrimitive(),Yo.push(hr,Zo),ge.setBuffer(i._roots[t]);let o=gp(0,i.geometry,e,n,s,r);ge.clearBuffer(),ru.releasePrimitive(hr),ru.releasePrimitive(Zo),Yo.pop(),Yo.pop();let a=Yo.length;return a>0&&(Zo=Yo[a-1],hr=Yo[a-2]),o}function gp(i,t,e,n,s=null,r=0,o=0){let{float32Array:a,uint16Array:l,uint32Array:c}=ge,f=i*2;if(Se(f,l)){let h=Pe(i,c),d=Be(f,l);return ke(i,a,hr),n(h,d,!1,o,r+i/8,hr)}else{let C=function(I){let{uint16Array:O,uint32Array:L}=ge,z=I*2;for(;!Se(z,O);)I=Ae(I),z=I*2;return Pe(I,L)},P=function(I){let{uint16Array:O,uint32Array:L}=ge,z=I*2;for(;!Se(z,O);)I=Ee(I,L),z=I*2;return Pe(I,L)+Be(z,O)},h=Ae(i),d=Ee(i,c),g=h,v=d,m,p,_,M;if(s&&(_=hr,M=Zo,ke(g,a,_),ke(v,a,M),m=s(_),p=s(M),p<m)){g=d,v=h;let I=m;m=p,p=I,_=M}_||(_=hr,ke(g,a,_));let y=Se(g*2,l),w=e(_,y,m,o+1,r+g/8),T;if(w===2){let I=C(g),L=P(g)-I;T=n(I,L,!0,o+1,r+g/8,_)}else T=w&&gp(g,t,e,n,s,r,o+1);if(T)return!0;M=Zo,ke(v,a,M);let x=Se(v*2,l),b=e(M,x,p,o+1,r+v/8),D;if(b===2){let I=C(v),L=P(v)-I;D=n(I,L,!0,o+1,r+v/8,M)}else D=b&&gp(v,t,e,n,s,r,o+1);return!!D}}var yl=new ge.constructor,ou=new ge.constructor,ur=new cr(()=>new Oe),$o=new Oe,Ko=new Oe,xp=new Oe,yp=new Oe,vp=!1;function u_(i,t,e,n){if(vp)throw new Error("MeshBVH: Recursive calls to bvhcast not supported.");vp=!0;let s=i._roots,r=t._roots,o,a=0,l=0,c=new te().copy(e).invert();for(let f=0,u=s.length;f<u;f++){yl.setBuffer(s[f]),l=0;let h=ur.getPrimitive();ke(0,yl.float32Array,h),h.applyMatrix4(c);for(let d=0,g=r.length;d<g&&(ou.setBuffer(r[d]),o=Yi(0,0,e,c,n,a,l,0,0,h),ou.clearBuffer(),l+=r[d].byteLength/32,!o);d++);if(ur.releasePrimitive(h),yl.clearBuffer(),a+=s[f].byteLength/32,o)break}return vp=!1,o}function Yi(i,t,e,n,s,r=0,o=0,a=0,l=0,c=null,f=!1){let u,h;f?(u=ou,h=yl):(u=yl,h=ou);let d=u.float32Array,g=u.uint32Array,v=u.uint16Array,m=h.float32Array,p=h.uint32Array,_=h.uint16Array,M=i*2,y=t*2,w=Se(M,v),T=Se(y,_),x=!1;if(T&&w)f?x=s(Pe(t,p),Be(t*2,_),Pe(i,g),Be(i*2,v),l,o+t/8,a,r+i/8):x=s(Pe(i,g),Be(i*2,v),Pe(t,p),Be(t*2,_),a,r+i/8,l,o+t/8);else if(T){let b=ur.getPrimitive();ke(t,m,b),b.applyMatrix4(e);let D=Ae(i),C=Ee(i,g);ke(D,d,$o),ke(C,d,Ko);let P=b.intersectsBox($o),I=b.intersectsBox(Ko);x=P&&Yi(t,D,n,e,s,o,r,l,a+1,b,!f)||I&&Yi(t,C,n,e,s,o,r,l,a+1,b,!f),ur.releasePrimitive(b)}else{let b=Ae(t),D=Ee(t,p);ke(b,m,xp),ke(D,m,yp);let C=c.intersectsBox(xp),P=c.intersectsBox(yp);if(C&&P)x=Yi(i,b,e,n,s,r,o,a,l+1,c,f)||Yi(i,D,e,n,s,r,o,a,l+1,c,f);else if(C)if(w)x=Yi(i,b,e,n,s,r,o,a,l+1,c,f);else{let I=ur.getPrimitive();I.copy(xp).applyMatrix4(e);let O=Ae(i),L=Ee(i,g);ke(O,d,$o),ke(L,d,Ko);let z=I.intersectsBox($o),X=I.intersectsBox(Ko);x=z&&Yi(b,O,n,e,s,o,r,l,a+1,I,!f)||X&&Yi(b,L,n,e,s,o,r,l,a+1,I,!f),ur.releasePrimitive(I)}else if(P)if(w)x=Yi(i,D,e,n,s,r,o,a,l+1,c,f);else{let I=ur.getPrimitive();I.copy(yp).applyMatrix4(e);let O=Ae(i),L=Ee(i,g);ke(O,d,$o),ke(L,d,Ko);let z=I.intersectsBox($o),X=I.intersectsBox(Ko);x=z&&Yi(D,O,n,e,s,o,r,l,a+1,I,!f)||X&&Yi(D,L,n,e,s,o,r,l,a+1,I,!f),ur.releasePrimitive(I)}}return x}var au=new class{constructor(){let i=null,t=null,e=null,n=!1;this.root=null,this.buffer=null,this.uint32Array=null,this.uint16Array=null,this.setBVH=(r,o)=>{if(n)throw new Error("BVHTraversalHelper: cannot call setBVH during an active traversal.");this.root=o,this.buffer=i=r._roots[o],this.uint16Array=e=new Uint16Array(i),this.uint32Array=t=new Uint32Array(i)},this.reset=()=>{this.root=null,this.buffer=i=null,this.uint16Array=e=null,this.uint32Array=t=null},this.getRangeStart=r=>{let o=r*2;for(;!Se(o,e);)r=Ae(r),o=r*2;return Pe(r,t)},this.getRangeEnd=r=>{let o=r*2;for(;!Se(o,e);)r=Ee(r,t),o=r*2;return Pe(r,t)+Be(o,e)};let s=(r,o,a)=>{let l=o*2,c=Se(l,e);if(!r(a,c,o)&&!c){let u=Ae(o),h=Ee(o,t);s(r,u,a+1),s(r,h,a+1)}};this.traverseBuffer=r=>{if(n)throw new Error("BVHTraversalHelper: cannot start a traversal during an active traversal.");n=!0;try{s(r,0,0)}finally{n=!1}},this.traverse=r=>{this.traverseBuffer((o,a,l)=>{if(a){let c=l*2,f=t[l+6],u=e[c+14];return r(o,a,new Float32Array(i,l*4,6),f,u)}else{let c=Wo(l,t);return r(o,a,new Float32Array(i,l*4,6),c)}})}}};var f_=new Oe,Jo=new Float32Array(6),lu=class{constructor(){this._roots=null,this.primitiveBuffer=null,this.primitiveBufferStride=null}init(t){t={...tu,...t},"maxLeafSize"in t&&(console.warn('BVH: "maxLeafSize" option has been deprecated. Use "targetLeafSize", instead.'),t={...t,targetLeafSize:t.maxLeafSize}),c_(this,t)}getRootRanges(){throw new Error("BVH: getRootRanges() not implemented")}writePrimitiveBounds(){throw new Error("BVH: writePrimitiveBounds() not implemented")}writePrimitiveRangeBounds(t,e,n,s){let r=1/0,o=1/0,a=1/0,l=-1/0,c=-1/0,f=-1/0;for(let u=t,h=t+e;u<h;u++){this.writePrimitiveBounds(u,Jo,0);let[d,g,v,m,p,_]=Jo;d<r&&(r=d),m>l&&(l=m),g<o&&(o=g),p>c&&(c=p),v<a&&(a=v),_>f&&(f=_)}return n[s+0]=r,n[s+1]=o,n[s+2]=a,n[s+3]=l,n[s+4]=c,n[s+5]=f,n}computePrimitiveBounds(t,e,n){let s=n.offset||0;for(let r=t,o=t+e;r<o;r++){this.writePrimitiveBounds(r,Jo,0);let[a,l,c,f,u,h]=Jo,d=(a+f)/2,g=(l+u)/2,v=(c+h)/2,m=(f-a)/2,p=(u-l)/2,_=(h-c)/2,M=(r-s)*6;n[M+0]=d,n[M+1]=m+(Math.abs(d)+m)*Ho,n[M+2]=g,n[M+3]=p+(Math.abs(g)+p)*Ho,n[M+4]=v,n[M+5]=_+(Math.abs(v)+_)*Ho}return n}shiftPrimitiveOffsets(t){let e=this._indirectBuffer;if(e)for(let n=0,s=e.length;n<s;n++)e[n]+=t;else{let n=this._roots;for(let s=0;s<n.length;s++){let r=n[s],o=new Uint32Array(r),a=new Uint16Array(r),l=r.byteLength/32;for(let c=0;c<l;c++){let f=8*c,u=2*f;Se(u,a)&&(o[f+6]+=t)}}}}traverse(t,e=0){au.setBVH(this,e),au.traverse(t),au.reset()}refit(){let t=this._roots;for(let e=0,n=t.length;e<n;e++){let s=t[e],r=new Uint32Array(s),o=new Uint16Array(s),a=new Float32Array(s),l=s.byteLength/32;for(let c=l-1;c>=0;c--){let f=c*8,u=f*2;if(Se(u,o)){let d=Pe(f,r),g=Be(u,o);this.writePrimitiveRangeBounds(d,g,Jo,0),a.set(Jo,f)}else{let d=Ae(f),g=Ee(f,r);for(let v=0;v<3;v++){let m=a[d+v],p=a[d+v+3],_=a[g+v],M=a[g+v+3];a[f+v]=m<_?m:_,a[f+v+3]=p>M?p:M}}}}}getBoundingBox(t){return t.makeEmpty(),this._roots.forEach(n=>{ke(0,new Float32Array(n),f_),t.union(f_)}),t}shapecast(t){let{boundsTraverseOrder:e,intersectsBounds:n,intersectsRange:s,intersectsPrimitive:r,scratchPrimitive:o,iterate:a}=t;if(s&&r){let u=s;s=(h,d,g,v,m)=>u(h,d,g,v,m)?!0:a(h,d,this,r,g,v,o)}else s||(r?s=(u,h,d,g)=>a(u,h,this,r,d,g,o):s=(u,h,d)=>d);let l=!1,c=0,f=this._roots;for(let u=0,h=f.length;u<h;u++){let d=f[u];if(l=h_(this,u,n,s,e,c),l)break;c+=d.byteLength/32}return l}bvhcast(t,e,n){let{intersectsRanges:s}=n;return u_(this,t,e,s)}};function d_(){return typeof SharedArrayBuffer<"u"}function Sp(i){return i.index?i.index.count:i.attributes.position.count}function fr(i){return Sp(i)/3}function mT(i,t=ArrayBuffer){return i>65535?new Uint32Array(new t(4*i)):new Uint16Array(new t(2*i))}function p_(i,t){if(!i.index){let e=i.attributes.position.count,n=t.useSharedArrayBuffer?SharedArrayBuffer:ArrayBuffer,s=mT(e,n);i.setIndex(new Je(s,1));for(let r=0;r<e;r++)s[r]=r}}function gT(i,t,e){let n=Sp(i)/e,s=t||i.drawRange,r=s.start/e,o=(s.start+s.count)/e,a=Math.max(0,r),l=Math.min(n,o)-a;return{offset:Math.floor(a),count:Math.floor(l)}}function _T(i,t){return i.groups.map(e=>({offset:e.start/t,count:e.count/t}))}function Mp(i,t,e){let n=gT(i,t,e),s=_T(i,e);if(!s.length)return[n];let r=[],o=n.offset,a=n.offset+n.count,l=Sp(i)/e,c=[];for(let h of s){let{offset:d,count:g}=h,v=d,m=isFinite(g)?g:l-d,p=d+m;v<a&&p>o&&(c.push({pos:Math.max(o,v),isStart:!0}),c.push({pos:Math.min(a,p),isStart:!1}))}c.sort((h,d)=>h.pos!==d.pos?h.pos-d.pos:h.type==="end"?-1:1);let f=0,u=null;for(let h of c){let d=h.pos;f!==0&&d!==u&&r.push({offset:u,count:d-u}),f+=h.isStart?1:-1,u=d}return r}function xT(i,t){let e=i[i.length-1],n=e.offset+e.count>2**16,s=i.reduce((c,f)=>c+f.count,0),r=n?4:2,o=t?new SharedArrayBuffer(s*r):new ArrayBuffer(s*r),a=n?new Uint32Array(o):new Uint16Array(o),l=0;for(let c=0;c<i.length;c++){let{offset:f,count:u}=i[c];for(let h=0;h<u;h++)a[l+h]=f+h;l+=u}return a}var cu=class extends lu{get indirect(){return!!this._indirectBuffer}get primitiveStride(){return null}get primitiveBufferStride(){return this.indirect?1:this.primitiveStride}set primitiveBufferStride(t){}get primitiveBuffer(){return this.indirect?this._indirectBuffer:this.geometry.index.array}set primitiveBuffer(t){}constructor(t,e={}){if(t.isBufferGeometry){if(t.index&&t.index.isInterleavedBufferAttribute)throw new Error("BVH: InterleavedBufferAttribute is not supported for the index attribute.")}else throw new Error("BVH: Only BufferGeometries are supported.");if(e.useSharedArrayBuffer&&!d_())throw new Error("BVH: SharedArrayBuffer is not available.");super(),this.geometry=t,this.resolvePrimitiveIndex=e.indirect?n=>this._indirectBuffer[n]:n=>n,this.primitiveBuffer=null,this.primitiveBufferStride=null,this._indirectBuffer=null,e={...tu,...e},e[_l]||this.init(e)}init(t){let{geometry:e,primitiveStride:n}=this;if(t.indirect){let s=Mp(e,t.range,n),r=xT(s,t.useSharedArrayBuffer);this._indirectBuffer=r}else p_(e,t);super.init(t),!e.boundingBox&&t.setBoundingBox&&(e.boundingBox=this.getBoundingBox(new Oe))}getRootRanges(t){return this.indirect?[{offset:0,count:this._indirectBuffer.length}]:Mp(this.geometry,t,this.primitiveStride)}raycastObject3D(){throw new Error("BVH: raycastObject3D() not implemented")}};var wi=class{constructor(){this.min=1/0,this.max=-1/0}setFromPointsField(t,e){let n=1/0,s=-1/0;for(let r=0,o=t.length;r<o;r++){let l=t[r][e];n=l<n?l:n,s=l>s?l:s}this.min=n,this.max=s}setFromPoints(t,e){let n=1/0,s=-1/0;for(let r=0,o=e.length;r<o;r++){let a=e[r],l=t.dot(a);n=l<n?l:n,s=l>s?l:s}this.min=n,this.max=s}isSeparated(t){return this.min>t.max||t.min>this.max}};wi.prototype.setFromBox=(function(){let i=new U;return function(e,n){let s=n.min,r=n.max,o=1/0,a=-1/0;for(let l=0;l<=1;l++)for(let c=0;c<=1;c++)for(let f=0;f<=1;f++){i.x=s.x*l+r.x*(1-l),i.y=s.y*c+r.y*(1-c),i.z=s.z*f+r.z*(1-f);let u=e.dot(i);o=Math.min(u,o),a=Math.max(u,a)}this.min=o,this.max=a}})();var yT=(function(){let i=new U,t=new U,e=new U;return function(s,r,o){let a=s.start,l=i,c=r.start,f=t;e.subVectors(a,c),i.subVectors(s.end,s.start),t.subVectors(r.end,r.start);let u=e.dot(f),h=f.dot(l),d=f.dot(f),g=e.dot(l),m=l.dot(l)*d-h*h,p,_;m!==0?p=(u*h-g*d)/m:p=0,_=(u+p*h)/d,o.x=p,o.y=_}})(),vl=(function(){let i=new kt,t=new U,e=new U;return function(s,r,o,a){yT(s,r,i);let l=i.x,c=i.y;if(l>=0&&l<=1&&c>=0&&c<=1){s.at(l,o),r.at(c,a);return}else if(l>=0&&l<=1){c<0?r.at(0,a):r.at(1,a),s.closestPointToPoint(a,!0,o);return}else if(c>=0&&c<=1){l<0?s.at(0,o):s.at(1,o),r.closestPointToPoint(o,!0,a);return}else{let f;l<0?f=s.start:f=s.end;let u;c<0?u=r.start:u=r.end;let h=t,d=e;if(s.closestPointToPoint(u,!0,t),r.closestPointToPoint(f,!0,e),h.distanceToSquared(u)<=d.distanceToSquared(f)){o.copy(h),a.copy(u);return}else{o.copy(f),a.copy(d);return}}}})(),m_=(function(){let i=new U,t=new U,e=new An,n=new oi;return function(r,o){let{radius:a,center:l}=r,{a:c,b:f,c:u}=o;if(n.start=c,n.end=f,n.closestPointToPoint(l,!0,i).distanceTo(l)<=a||(n.start=c,n.end=u,n.closestPointToPoint(l,!0,i).distanceTo(l)<=a)||(n.start=f,n.end=u,n.closestPointToPoint(l,!0,i).distanceTo(l)<=a))return!0;let v=o.getPlane(e);if(Math.abs(v.distanceToPoint(l))<=a){let p=v.projectPoint(l,t);if(o.containsPoint(p))return!0}return!1}})();var vT=["x","y","z"],Os=1e-15,g_=Os*Os;function Li(i){return Math.abs(i)<Os}var Xn=class extends kn{constructor(...t){super(...t),this.isExtendedTriangle=!0,this.satAxes=new Array(4).fill().map(()=>new U),this.satBounds=new Array(4).fill().map(()=>new wi),this.points=[this.a,this.b,this.c],this.plane=new An,this.isDegenerateIntoSegment=!1,this.isDegenerateIntoPoint=!1,this.degenerateSegment=new oi,this.needsUpdate=!0}intersectsSphere(t){return m_(t,this)}update(){let t=this.a,e=this.b,n=this.c,s=this.points,r=this.satAxes,o=this.satBounds,a=r[0],l=o[0];this.getNormal(a),l.setFromPoints(a,s);let c=r[1],f=o[1];c.subVectors(t,e),f.setFromPoints(c,s);let u=r[2],h=o[2];u.subVectors(e,n),h.setFromPoints(u,s);let d=r[3],g=o[3];d.subVectors(n,t),g.setFromPoints(d,s);let v=c.length(),m=u.length(),p=d.length();this.isDegenerateIntoPoint=!1,this.isDegenerateIntoSegment=!1,v<Os?m<Os||p<Os?this.isDegenerateIntoPoint=!0:(this.isDegenerateIntoSegment=!0,this.degenerateSegment.start.copy(t),this.degenerateSegment.end.copy(n)):m<Os?p<Os?this.isDegenerateIntoPoint=!0:(this.isDegenerateIntoSegment=!0,this.degenerateSegment.start.copy(e),this.degenerateSegment.end.copy(t)):p<Os&&(this.isDegenerateIntoSegment=!0,this.degenerateSegment.start.copy(n),this.degenerateSegment.end.copy(e)),this.plane.setFromNormalAndCoplanarPoint(a,t),this.needsUpdate=!1}};Xn.prototype.closestPointToSegment=(function(){let i=new U,t=new U,e=new oi;return function(s,r=null,o=null){this.needsUpdate&&this.update();let{start:a,end:l}=s,c=this.points,f,u=1/0,h=this.plane.distanceToPoint(a),d=this.plane.distanceToPoint(l);if(h*d<0&&this.plane.intersectLine(s,i)!==null&&this.containsPoint(i))return r&&r.copy(i),o&&o.copy(i),0;for(let g=0;g<3;g++){let v=(g+1)%3;e.start.copy(c[g]),e.end.copy(c[v]),vl(e,s,i,t),f=i.distanceToSquared(t),f<u&&(u=f,r&&r.copy(i),o&&o.copy(t))}return this.closestPointToPoint(a,i),f=a.distanceToSquared(i),f<u&&(u=f,r&&r.copy(i),o&&o.copy(a)),this.closestPointToPoint(l,i),f=l.distanceToSquared(i),f<u&&(u=f,r&&r.copy(i),o&&o.copy(l)),Math.sqrt(u)}})();Xn.prototype.intersectsTriangle=(function(){let i=new Xn,t=new wi,e=new wi,n=new U,s=new U,r=new U,o=new U,a=new oi,l=new oi,c=new U,f=new kt,u=new kt;function h(M,y,w,T){let x=n;!M.isDegenerateIntoPoint&&!M.isDegenerateIntoSegment?x.copy(M.plane.normal):x.copy(y.plane.normal);let b=M.satBounds,D=M.satAxes;for(let I=1;I<4;I++){let O=b[I],L=D[I];if(t.setFromPoints(L,y.points),O.isSeparated(t)||(o.copy(x).cross(L),t.setFromPoints(o,M.points),e.setFromPoints(o,y.points),t.isSeparated(e)))return!1}let C=y.satBounds,P=y.satAxes;for(let I=1;I<4;I++){let O=C[I],L=P[I];if(t.setFromPoints(L,M.points),O.isSeparated(t)||(o.crossVectors(x,L),t.setFromPoints(o,M.points),e.setFromPoints(o,y.points),t.isSeparated(e)))return!1}return w&&(T||console.warn("ExtendedTriangle.intersectsTriangle: Triangles are coplanar which does not support an output edge. Setting edge to 0, 0, 0."),w.start.set(0,0,0),w.end.set(0,0,0)),!0}function d(M,y,w,T,x,b,D,C,P,I,O){let L=D/(D-C);I.x=T+(x-T)*L,O.start.subVectors(y,M).multiplyScalar(L).add(M),L=D/(D-P),I.y=T+(b-T)*L,O.end.subVectors(w,M).multiplyScalar(L).add(M)}function g(M,y,w,T,x,b,D,C,P,I,O){if(x>0)d(M.c,M.a,M.b,T,y,w,P,D,C,I,O);else if(b>0)d(M.b,M.a,M.c,w,y,T,C,D,P,I,O);else if(C*P>0||D!=0)d(M.a,M.b,M.c,y,w,T,D,C,P,I,O);else if(C!=0)d(M.b,M.a,M.c,w,y,T,C,D,P,I,O);else if(P!=0)d(M.c,M.a,M.b,T,y,w,P,D,C,I,O);else return!0;return!1}function v(M,y,w,T){let x=y.degenerateSegment,b=M.plane.distanceToPoint(x.start),D=M.plane.distanceToPoint(x.end);return Li(b)?Li(D)?h(M,y,w,T):(w&&(w.start.copy(x.start),w.end.copy(x.start)),M.containsPoint(x.start)):Li(D)?(w&&(w.start.copy(x.end),w.end.copy(x.end)),M.containsPoint(x.end)):M.plane.intersectLine(x,n)!=null?(w&&(w.start.copy(n),w.end.copy(n)),M.containsPoint(n)):!1}function m(M,y,w){let T=y.a;return Li(M.plane.distanceToPoint(T))&&M.containsPoint(T)?(w&&(w.start.copy(T),w.end.copy(T)),!0):!1}function p(M,y,w){let T=M.degenerateSegment,x=y.a;return T.closestPointToPoint(x,!0,n),x.distanceToSquared(n)<g_?(w&&(w.start.copy(x),w.end.copy(x)),!0):!1}function _(M,y,w,T){if(M.isDegenerateIntoSegment)if(y.isDegenerateIntoSegment){let x=M.degenerateSegment,b=y.degenerateSegment,D=s,C=r;x.delta(D),b.delta(C);let P=n.subVectors(b.start,x.start),I=D.x*C.y-D.y*C.x;if(Li(I))return!1;let O=(P.x*C.y-P.y*C.x)/I,L=-(D.x*P.y-D.y*P.x)/I;if(O<0||O>1||L<0||L>1)return!1;let z=x.start.z+D.z*O,X=b.start.z+C.z*L;return Li(z-X)?(w&&(w.start.copy(x.start).addScaledVector(D,O),w.end.copy(x.start).addScaledVector(D,O)),!0):!1}else return y.isDegenerateIntoPoint?p(M,y,w):v(y,M,w,T);else{if(M.isDegenerateIntoPoint)return y.isDegenerateIntoPoint?y.a.distanceToSquared(M.a)<g_?(w&&(w.start.copy(M.a),w.end.copy(M.a)),!0):!1:y.isDegenerateIntoSegment?p(y,M,w):m(y,M,w);if(y.isDegenerateIntoPoint)return m(M,y,w);if(y.isDegenerateIntoSegment)return v(M,y,w,T)}}return function(y,w=null,T=!1){this.needsUpdate&&this.update(),y.isExtendedTriangle?y.needsUpdate&&y.update():(i.copy(y),i.update(),y=i);let x=_(this,y,w,T);if(x!==void 0)return x;let b=this.plane,D=y.plane,C=D.distanceToPoint(this.a),P=D.distanceToPoint(this.b),I=D.distanceToPoint(this.c);Li(C)&&(C=0),Li(P)&&(P=0),Li(I)&&(I=0);let O=C*P,L=C*I;if(O>0&&L>0)return!1;let z=b.distanceToPoint(y.a),X=b.distanceToPoint(y.b),H=b.distanceToPoint(y.c);Li(z)&&(z=0),Li(X)&&(X=0),Li(H)&&(H=0);let at=z*X,Z=z*H;if(at>0&&Z>0)return!1;s.copy(b.normal),r.copy(D.normal);let j=s.cross(r),nt=0,ut=Math.abs(j.x),ht=Math.abs(j.y);ht>ut&&(ut=ht,nt=1),Math.abs(j.z)>ut&&(nt=2);let dt=vT[nt],gt=this.a[dt],Et=this.b[dt],St=this.c[dt],Ht=y.a[dt],ne=y.b[dt],Vt=y.c[dt];if(g(this,gt,Et,St,O,L,C,P,I,f,a))return h(this,y,w,T);if(g(y,Ht,ne,Vt,at,Z,z,X,H,u,l))return h(this,y,w,T);if(f.y<f.x){let le=f.y;f.y=f.x,f.x=le,c.copy(a.start),a.start.copy(a.end),a.end.copy(c)}if(u.y<u.x){let le=u.y;u.y=u.x,u.x=le,c.copy(l.start),l.start.copy(l.end),l.end.copy(c)}return f.y<u.x||u.y<f.x?!1:(w&&(u.x>f.x?w.start.copy(l.start):w.start.copy(a.start),u.y<f.y?w.end.copy(l.end):w.end.copy(a.end)),!0)}})();Xn.prototype.distanceToPoint=(function(){let i=new U;return function(e){return this.closestPointToPoint(e,i),e.distanceTo(i)}})();Xn.prototype.distanceToTriangle=(function(){let i=new U,t=new U,e=["a","b","c"],n=new oi,s=new oi;return function(o,a=null,l=null){let c=a||l?n:null;if(this.intersectsTriangle(o,c,!0))return(a||l)&&(a&&c.getCenter(a),l&&c.getCenter(l)),0;let f=1/0;for(let u=0;u<3;u++){let h,d=e[u],g=o[d];this.closestPointToPoint(g,i),h=g.distanceToSquared(i),h<f&&(f=h,a&&a.copy(i),l&&l.copy(g));let v=this[d];o.closestPointToPoint(v,i),h=v.distanceToSquared(i),h<f&&(f=h,a&&a.copy(v),l&&l.copy(i))}for(let u=0;u<3;u++){let h=e[u],d=e[(u+1)%3];n.set(this[h],this[d]);for(let g=0;g<3;g++){let v=e[g],m=e[(g+1)%3];s.set(o[v],o[m]),vl(n,s,i,t);let p=i.distanceToSquared(t);p<f&&(f=p,a&&a.copy(i),l&&l.copy(t))}}return Math.sqrt(f)}})();var hn=class{constructor(t,e,n){this.isOrientedBox=!0,this.min=new U,this.max=new U,this.matrix=new te,this.invMatrix=new te,this.points=new Array(8).fill().map(()=>new U),this.satAxes=new Array(3).fill().map(()=>new U),this.satBounds=new Array(3).fill().map(()=>new wi),this.alignedSatBounds=new Array(3).fill().map(()=>new wi),this.needsUpdate=!1,t&&this.min.copy(t),e&&this.max.copy(e),n&&this.matrix.copy(n)}set(t,e,n){this.min.copy(t),this.max.copy(e),this.matrix.copy(n),this.needsUpdate=!0}copy(t){this.min.copy(t.min),this.max.copy(t.max),this.matrix.copy(t.matrix),this.needsUpdate=!0}};hn.prototype.update=(function(){return function(){let t=this.matrix,e=this.min,n=this.max,s=this.points;for(let c=0;c<=1;c++)for(let f=0;f<=1;f++)for(let u=0;u<=1;u++){let h=1*c|2*f|4*u,d=s[h];d.x=c?n.x:e.x,d.y=f?n.y:e.y,d.z=u?n.z:e.z,d.applyMatrix4(t)}let r=this.satBounds,o=this.satAxes,a=s[0];for(let c=0;c<3;c++){let f=o[c],u=r[c],h=1<<c,d=s[h];f.subVectors(a,d),u.setFromPoints(f,s)}let l=this.alignedSatBounds;l[0].setFromPointsField(s,"x"),l[1].setFromPointsField(s,"y"),l[2].setFromPointsField(s,"z"),this.invMatrix.copy(this.matrix).invert(),this.needsUpdate=!1}})();hn.prototype.intersectsBox=(function(){let i=new wi;return function(e){this.needsUpdate&&this.update();let n=e.min,s=e.max,r=this.satBounds,o=this.satAxes,a=this.alignedSatBounds;if(i.min=n.x,i.max=s.x,a[0].isSeparated(i)||(i.min=n.y,i.max=s.y,a[1].isSeparated(i))||(i.min=n.z,i.max=s.z,a[2].isSeparated(i)))return!1;for(let l=0;l<3;l++){let c=o[l],f=r[l];if(i.setFromBox(c,e),f.isSeparated(i))return!1}return!0}})();hn.prototype.intersectsTriangle=(function(){let i=new Xn,t=new Array(3),e=new wi,n=new wi,s=new U;return function(o){this.needsUpdate&&this.update(),o.isExtendedTriangle?o.needsUpdate&&o.update():(i.copy(o),i.update(),o=i);let a=this.satBounds,l=this.satAxes;t[0]=o.a,t[1]=o.b,t[2]=o.c;for(let h=0;h<3;h++){let d=a[h],g=l[h];if(e.setFromPoints(g,t),d.isSeparated(e))return!1}let c=o.satBounds,f=o.satAxes,u=this.points;for(let h=0;h<3;h++){let d=c[h],g=f[h];if(e.setFromPoints(g,u),d.isSeparated(e))return!1}for(let h=0;h<3;h++){let d=l[h];for(let g=0;g<4;g++){let v=f[g];if(s.crossVectors(d,v),e.setFromPoints(s,t),n.setFromPoints(s,u),e.isSeparated(n))return!1}}return!0}})();hn.prototype.closestPointToPoint=(function(){return function(t,e){return this.needsUpdate&&this.update(),e.copy(t).applyMatrix4(this.invMatrix).clamp(this.min,this.max).applyMatrix4(this.matrix),e}})();hn.prototype.distanceToPoint=(function(){let i=new U;return function(e){return this.closestPointToPoint(e,i),e.distanceTo(i)}})();hn.prototype.distanceToBox=(function(){let i=["x","y","z"],t=new Array(12).fill().map(()=>new oi),e=new Array(12).fill().map(()=>new oi),n=new U,s=new U;return function(o,a=0,l=null,c=null){if(this.needsUpdate&&this.update(),this.intersectsBox(o))return(l||c)&&(o.getCenter(s),this.closestPointToPoint(s,n),o.closestPointToPoint(n,s),l&&l.copy(n),c&&c.copy(s)),0;let f=a*a,u=o.min,h=o.max,d=this.points,g=1/0;for(let m=0;m<8;m++){let p=d[m];s.copy(p).clamp(u,h);let _=p.distanceToSquared(s);if(_<g&&(g=_,l&&l.copy(p),c&&c.copy(s),_<f))return Math.sqrt(_)}let v=0;for(let m=0;m<3;m++)for(let p=0;p<=1;p++)for(let _=0;_<=1;_++){let M=(m+1)%3,y=(m+2)%3,w=p<<M|_<<y,T=1<<m|p<<M|_<<y,x=d[w],b=d[T];t[v].set(x,b);let C=i[m],P=i[M],I=i[y],O=e[v],L=O.start,z=O.end;L[C]=u[C],L[P]=p?u[P]:h[P],L[I]=_?u[I]:h[I],z[C]=h[C],z[P]=p?u[P]:h[P],z[I]=_?u[I]:h[I],v++}for(let m=0;m<=1;m++)for(let p=0;p<=1;p++)for(let _=0;_<=1;_++){s.x=m?h.x:u.x,s.y=p?h.y:u.y,s.z=_?h.z:u.z,this.closestPointToPoint(s,n);let M=s.distanceToSquared(n);if(M<g&&(g=M,l&&l.copy(n),c&&c.copy(s),M<f))return Math.sqrt(M)}for(let m=0;m<12;m++){let p=t[m];for(let _=0;_<12;_++){let M=e[_];vl(p,M,n,s);let y=n.distanceToSquared(s);if(y<g&&(g=y,l&&l.copy(n),c&&c.copy(s),y<f))return Math.sqrt(y)}}return Math.sqrt(g)}})();var bp=class extends cr{constructor(){super(()=>new Xn)}},ai=new bp;var Sl=new U,wp=new U;function __(i,t,e={},n=0,s=1/0){let r=n*n,o=s*s,a=1/0,l=null;if(i.shapecast({boundsTraverseOrder:f=>(Sl.copy(t).clamp(f.min,f.max),Sl.distanceToSquared(t)),intersectsBounds:(f,u,h)=>h<a&&h<o,intersectsTriangle:(f,u)=>{f.closestPointToPoint(t,Sl);let h=t.distanceToSquared(Sl);return h<a&&(wp.copy(Sl),a=h,l=u),h<r}}),a===1/0)return null;let c=Math.sqrt(a);return e.point?e.point.copy(wp):e.point=wp.clone(),e.distance=c,e.faceIndex=l,e}var hu=parseInt("187")>=169,ST=parseInt("187")<=161,Lr=new U,Dr=new U,Nr=new U,uu=new kt,fu=new kt,du=new kt,x_=new U,y_=new U,v_=new U,Ml=new U;function MT(i,t,e,n,s,r,o,a){let l;if(r===Cn?l=i.intersectTriangle(n,e,t,!0,s):l=i.intersectTriangle(t,e,n,r!==$n,s),l===null)return null;let c=i.origin.distanceTo(s);return c<o||c>a?null:{distance:c,point:s.clone()}}function S_(i,t,e,n,s,r,o,a,l,c,f){Lr.fromBufferAttribute(t,r),Dr.fromBufferAttribute(t,o),Nr.fromBufferAttribute(t,a);let u=MT(i,Lr,Dr,Nr,Ml,l,c,f);if(u){if(n){uu.fromBufferAttribute(n,r),fu.fromBufferAttribute(n,o),du.fromBufferAttribute(n,a),u.uv=new kt;let d=kn.getInterpolation(Ml,Lr,Dr,Nr,uu,fu,du,u.uv);hu||(u.uv=d)}if(s){uu.fromBufferAttribute(s,r),fu.fromBufferAttribute(s,o),du.fromBufferAttribute(s,a),u.uv1=new kt;let d=kn.getInterpolation(Ml,Lr,Dr,Nr,uu,fu,du,u.uv1);hu||(u.uv1=d),ST&&(u.uv2=u.uv1)}if(e){x_.fromBufferAttribute(e,r),y_.fromBufferAttribute(e,o),v_.fromBufferAttribute(e,a),u.normal=new U;let d=kn.getInterpolation(Ml,Lr,Dr,Nr,x_,y_,v_,u.normal);u.normal.dot(i.direction)>0&&u.normal.multiplyScalar(-1),hu||(u.normal=d)}let h={a:r,b:o,c:a,normal:new U,materialIndex:0};if(kn.getNormal(Lr,Dr,Nr,h.normal),u.face=h,u.faceIndex=r,hu){let d=new U;kn.getBarycoord(Ml,Lr,Dr,Nr,d),u.barycoord=d}}return u}function M_(i){return i&&i.isMaterial?i.side:i}function jo(i,t,e,n,s,r,o){let a=n*3,l=a+0,c=a+1,f=a+2,{index:u,groups:h}=i;i.index&&(l=u.getX(l),c=u.getX(c),f=u.getX(f));let{position:d,normal:g,uv:v,uv1:m}=i.attributes;if(Array.isArray(t)){let p=n*3;for(let _=0,M=h.length;_<M;_++){let{start:y,count:w,materialIndex:T}=h[_];if(p>=y&&p<y+w){let x=M_(t[T]),b=S_(e,d,g,v,m,l,c,f,x,r,o);if(b)if(b.faceIndex=n,b.face.materialIndex=T,s)s.push(b);else return b}}}else{let p=M_(t),_=S_(e,d,g,v,m,l,c,f,p,r,o);if(_)if(_.faceIndex=n,_.face.materialIndex=0,s)s.push(_);else return _}return null}function Ve(i,t,e,n){let s=i.a,r=i.b,o=i.c,a=t,l=t+1,c=t+2;e&&(a=e.getX(a),l=e.getX(l),c=e.getX(c)),s.x=n.getX(a),s.y=n.getY(a),s.z=n.getZ(a),r.x=n.getX(l),r.y=n.getY(l),r.z=n.getZ(l),o.x=n.getX(c),o.y=n.getY(c),o.z=n.getZ(c)}function b_(i,t,e,n,s,r,o,a){let{geometry:l,_indirectBuffer:c}=i;for(let f=n,u=n+s;f<u;f++)jo(l,t,e,f,r,o,a)}function w_(i,t,e,n,s,r,o){let{geometry:a,_indirectBuffer:l}=i,c=1/0,f=null;for(let u=n,h=n+s;u<h;u++){let d;d=jo(a,t,e,u,null,r,o),d&&d.distance<c&&(f=d,c=d.distance)}return f}function T_(i,t,e,n,s,r,o){let{geometry:a}=e,{index:l}=a,c=a.attributes.position;for(let f=i,u=t+i;f<u;f++){let h;if(h=f,Ve(o,h*3,l,c),o.needsUpdate=!0,n(o,h,s,r))return!0}return!1}function A_(i,t=null){t&&Array.isArray(t)&&(t=new Set(t));let e=i.geometry,n=e.index?e.index.array:null,s=e.attributes.position,r,o,a,l,c=0,f=i._roots;for(let h=0,d=f.length;h<d;h++)r=f[h],o=new Uint32Array(r),a=new Uint16Array(r),l=new Float32Array(r),u(0,c),c+=r.byteLength;function u(h,d,g=!1){let v=h*2;if(Se(v,a)){let m=Pe(h,o),p=Be(v,a),_=1/0,M=1/0,y=1/0,w=-1/0,T=-1/0,x=-1/0;for(let b=3*m,D=3*(m+p);b<D;b++){let C=n[b],P=s.getX(C),I=s.getY(C),O=s.getZ(C);P<_&&(_=P),P>w&&(w=P),I<M&&(M=I),I>T&&(T=I),O<y&&(y=O),O>x&&(x=O)}return l[h+0]!==_||l[h+1]!==M||l[h+2]!==y||l[h+3]!==w||l[h+4]!==T||l[h+5]!==x?(l[h+0]=_,l[h+1]=M,l[h+2]=y,l[h+3]=w,l[h+4]=T,l[h+5]=x,!0):!1}else{let m=Ae(h),p=Ee(h,o),_=g,M=!1,y=!1;if(t){if(!_){let C=m/8+d/32,P=p/8+d/32;M=t.has(C),y=t.has(P),_=!M&&!y}}else M=!0,y=!0;let w=_||M,T=_||y,x=!1;w&&(x=u(m,d,_));let b=!1;T&&(b=u(p,d,_));let D=x||b;if(D)for(let C=0;C<3;C++){let P=m+C,I=p+C,O=l[P],L=l[P+3],z=l[I],X=l[I+3];l[h+C]=O<z?O:z,l[h+C+3]=L>X?L:X}return D}}}function Jn(i,t,e,n,s){let r,o,a,l,c,f,u=1/e.direction.x,h=1/e.direction.y,d=1/e.direction.z,g=e.origin.x,v=e.origin.y,m=e.origin.z,p=t[i],_=t[i+3],M=t[i+1],y=t[i+3+1],w=t[i+2],T=t[i+3+2];return u>=0?(r=(p-g)*u,o=(_-g)*u):(r=(_-g)*u,o=(p-g)*u),h>=0?(a=(M-v)*h,l=(y-v)*h):(a=(y-v)*h,l=(M-v)*h),r>l||a>o||((a>r||isNaN(r))&&(r=a),(l<o||isNaN(o))&&(o=l),d>=0?(c=(w-m)*d,f=(T-m)*d):(c=(T-m)*d,f=(w-m)*d),r>f||c>o)?!1:((c>r||r!==r)&&(r=c),(f<o||o!==o)&&(o=f),r<=s&&o>=n)}function E_(i,t,e,n,s,r,o,a){let{geometry:l,_indirectBuffer:c}=i;for(let f=n,u=n+s;f<u;f++){let h=c?c[f]:f;jo(l,t,e,h,r,o,a)}}function C_(i,t,e,n,s,r,o){let{geometry:a,_indirectBuffer:l}=i,c=1/0,f=null;for(let u=n,h=n+s;u<h;u++){let d;d=jo(a,t,e,l?l[u]:u,null,r,o),d&&d.distance<c&&(f=d,c=d.distance)}return f}function R_(i,t,e,n,s,r,o){let{geometry:a}=e,{index:l}=a,c=a.attributes.position;for(let f=i,u=t+i;f<u;f++){let h;if(h=e.resolveTriangleIndex(f),Ve(o,h*3,l,c),o.needsUpdate=!0,n(o,h,s,r))return!0}return!1}function P_(i,t,e,n,s,r,o){ge.setBuffer(i._roots[t]),Jn(0,ge.float32Array,n,r,o)&&Tp(0,i,e,n,s,r,o),ge.clearBuffer()}function Tp(i,t,e,n,s,r,o){let{float32Array:a,uint16Array:l,uint32Array:c}=ge,f=i*2;if(Se(f,l)){let h=Pe(i,c),d=Be(f,l);b_(t,e,n,h,d,s,r,o)}else{let h=Ae(i);Jn(h,a,n,r,o)&&Tp(h,t,e,n,s,r,o);let d=Ee(i,c);Jn(d,a,n,r,o)&&Tp(d,t,e,n,s,r,o)}}var bT=["x","y","z"];function I_(i,t,e,n,s,r){ge.setBuffer(i._roots[t]);let o=null;return Jn(0,ge.float32Array,n,s,r)&&(o=Ap(0,i,e,n,s,r)),ge.clearBuffer(),o}function Ap(i,t,e,n,s,r){let{float32Array:o,uint16Array:a,uint32Array:l}=ge,c=i*2;if(Se(c,a)){let u=Pe(i,l),h=Be(c,a);return w_(t,e,n,u,h,s,r)}else{let u=Wo(i,l),h=bT[u],g=n.direction[h]>=0,v,m;g?(v=Ae(i),m=Ee(i,l)):(v=Ee(i,l),m=Ae(i));let _=Jn(v,o,n,s,r)?Ap(v,t,e,n,s,r):null;if(_){let w=_.point[h];if(g?w<=o[m+u]:w>=o[m+u+3])return _}let y=Jn(m,o,n,s,r)?Ap(m,t,e,n,s,r):null;return _&&y?_.distance<=y.distance?_:y:_||y||null}}var pu=new Oe,Qo=new Xn,ta=new Xn,bl=new te,L_=new hn,mu=new hn;function D_(i,t,e,n){ge.setBuffer(i._roots[t]);let s=Ep(0,i,e,n);return ge.clearBuffer(),s}function Ep(i,t,e,n,s=null){let{float32Array:r,uint16Array:o,uint32Array:a}=ge,l=i*2;if(s===null&&(e.boundingBox||e.computeBoundingBox(),L_.set(e.boundingBox.min,e.boundingBox.max,n),s=L_),Se(l,o)){let f=t.geometry,u=f.index,h=f.attributes.position,d=e.index,g=e.attributes.position,v=Pe(i,a),m=Be(l,o);if(bl.copy(n).invert(),e.boundsTree)return ke(i,r,mu),mu.matrix.copy(bl),mu.needsUpdate=!0,e.boundsTree.shapecast({intersectsBounds:_=>mu.intersectsBox(_),intersectsTriangle:_=>{_.a.applyMatrix4(n),_.b.applyMatrix4(n),_.c.applyMatrix4(n),_.needsUpdate=!0;for(let M=v*3,y=(m+v)*3;M<y;M+=3)if(Ve(ta,M,u,h),ta.needsUpdate=!0,_.intersectsTriangle(ta))return!0;return!1}});{let p=fr(e);for(let _=v*3,M=(m+v)*3;_<M;_+=3){Ve(Qo,_,u,h),Qo.a.applyMatrix4(bl),Qo.b.applyMatrix4(bl),Qo.c.applyMatrix4(bl),Qo.needsUpdate=!0;for(let y=0,w=p*3;y<w;y+=3)if(Ve(ta,y,d,g),ta.needsUpdate=!0,Qo.intersectsTriangle(ta))return!0}}}else{let f=Ae(i),u=Ee(i,a);return ke(f,r,pu),!!(s.intersectsBox(pu)&&Ep(f,t,e,n,s)||(ke(u,r,pu),s.intersectsBox(pu)&&Ep(u,t,e,n,s)))}}var gu=new te,Cp=new hn,wl=new hn,wT=new U,TT=new U,AT=new U,ET=new U;function N_(i,t,e,n={},s={},r=0,o=1/0){t.boundingBox||t.computeBoundingBox(),Cp.set(t.boundingBox.min,t.boundingBox.max,e),Cp.needsUpdate=!0;let a=i.geometry,l=a.attributes.position,c=a.index,f=t.attributes.position,u=t.index,h=ai.getPrimitive(),d=ai.getPrimitive(),g=wT,v=TT,m=null,p=null;s&&(m=AT,p=ET);let _=1/0,M=null,y=null;return gu.copy(e).invert(),wl.matrix.copy(gu),i.shapecast({boundsTraverseOrder:w=>Cp.distanceToBox(w),intersectsBounds:(w,T,x)=>x<_&&x<o?(T&&(wl.min.copy(w.min),wl.max.copy(w.max),wl.needsUpdate=!0),!0):!1,intersectsRange:(w,T)=>{if(t.boundsTree)return t.boundsTree.shapecast({boundsTraverseOrder:b=>wl.distanceToBox(b),intersectsBounds:(b,D,C)=>C<_&&C<o,intersectsRange:(b,D)=>{for(let C=b,P=b+D;C<P;C++){Ve(d,3*C,u,f),d.a.applyMatrix4(e),d.b.applyMatrix4(e),d.c.applyMatrix4(e),d.needsUpdate=!0;for(let I=w,O=w+T;I<O;I++){Ve(h,3*I,c,l),h.needsUpdate=!0;let L=h.distanceToTriangle(d,g,m);if(L<_&&(v.copy(g),p&&p.copy(m),_=L,M=I,y=C),L<r)return!0}}}});{let x=fr(t);for(let b=0,D=x;b<D;b++){Ve(d,3*b,u,f),d.a.applyMatrix4(e),d.b.applyMatrix4(e),d.c.applyMatrix4(e),d.needsUpdate=!0;for(let C=w,P=w+T;C<P;C++){Ve(h,3*C,c,l),h.needsUpdate=!0;let I=h.distanceToTriangle(d,g,m);if(I<_&&(v.copy(g),p&&p.copy(m),_=I,M=C,y=b),I<r)return!0}}}}}),ai.releasePrimitive(h),ai.releasePrimitive(d),_===1/0?null:(n.point?n.point.copy(v):n.point=v.clone(),n.distance=_,n.faceIndex=M,s&&(s.point?s.point.copy(p):s.point=p.clone(),s.point.applyMatrix4(gu),v.applyMatrix4(gu),s.distance=v.sub(s.point).length(),s.faceIndex=y),n)}function U_(i,t=null){t&&Array.isArray(t)&&(t=new Set(t));let e=i.geometry,n=e.index?e.index.array:null,s=e.attributes.position,r,o,a,l,c=0,f=i._roots;for(let h=0,d=f.length;h<d;h++)r=f[h],o=new Uint32Array(r),a=new Uint16Array(r),l=new Float32Array(r),u(0,c),c+=r.byteLength;function u(h,d,g=!1){let v=h*2;if(Se(v,a)){let m=Pe(h,o),p=Be(v,a),_=1/0,M=1/0,y=1/0,w=-1/0,T=-1/0,x=-1/0;for(let b=m,D=m+p;b<D;b++){let C=3*i.resolveTriangleIndex(b);for(let P=0;P<3;P++){let I=C+P;I=n?n[I]:I;let O=s.getX(I),L=s.getY(I),z=s.getZ(I);O<_&&(_=O),O>w&&(w=O),L<M&&(M=L),L>T&&(T=L),z<y&&(y=z),z>x&&(x=z)}}return l[h+0]!==_||l[h+1]!==M||l[h+2]!==y||l[h+3]!==w||l[h+4]!==T||l[h+5]!==x?(l[h+0]=_,l[h+1]=M,l[h+2]=y,l[h+3]=w,l[h+4]=T,l[h+5]=x,!0):!1}else{let m=Ae(h),p=Ee(h,o),_=g,M=!1,y=!1;if(t){if(!_){let C=m/8+d/32,P=p/8+d/32;M=t.has(C),y=t.has(P),_=!M&&!y}}else M=!0,y=!0;let w=_||M,T=_||y,x=!1;w&&(x=u(m,d,_));let b=!1;T&&(b=u(p,d,_));let D=x||b;if(D)for(let C=0;C<3;C++){let P=m+C,I=p+C,O=l[P],L=l[P+3],z=l[I],X=l[I+3];l[h+C]=O<z?O:z,l[h+C+3]=L>X?L:X}return D}}}function F_(i,t,e,n,s,r,o){ge.setBuffer(i._roots[t]),Jn(0,ge.float32Array,n,r,o)&&Rp(0,i,e,n,s,r,o),ge.clearBuffer()}function Rp(i,t,e,n,s,r,o){let{float32Array:a,uint16Array:l,uint32Array:c}=ge,f=i*2;if(Se(f,l)){let h=Pe(i,c),d=Be(f,l);E_(t,e,n,h,d,s,r,o)}else{let h=Ae(i);Jn(h,a,n,r,o)&&Rp(h,t,e,n,s,r,o);let d=Ee(i,c);Jn(d,a,n,r,o)&&Rp(d,t,e,n,s,r,o)}}var CT=["x","y","z"];function O_(i,t,e,n,s,r){ge.setBuffer(i._roots[t]);let o=null;return Jn(0,ge.float32Array,n,s,r)&&(o=Pp(0,i,e,n,s,r)),ge.clearBuffer(),o}function Pp(i,t,e,n,s,r){let{float32Array:o,uint16Array:a,uint32Array:l}=ge,c=i*2;if(Se(c,a)){let u=Pe(i,l),h=Be(c,a);return C_(t,e,n,u,h,s,r)}else{let u=Wo(i,l),h=CT[u],g=n.direction[h]>=0,v,m;g?(v=Ae(i),m=Ee(i,l)):(v=Ee(i,l),m=Ae(i));let _=Jn(v,o,n,s,r)?Pp(v,t,e,n,s,r):null;if(_){let w=_.point[h];if(g?w<=o[m+u]:w>=o[m+u+3])return _}let y=Jn(m,o,n,s,r)?Pp(m,t,e,n,s,r):null;return _&&y?_.distance<=y.distance?_:y:_||y||null}}var _u=new Oe,ea=new Xn,na=new Xn,Tl=new te,B_=new hn,xu=new hn;function z_(i,t,e,n){ge.setBuffer(i._roots[t]);let s=Ip(0,i,e,n);return ge.clearBuffer(),s}function Ip(i,t,e,n,s=null){let{float32Array:r,uint16Array:o,uint32Array:a}=ge,l=i*2;if(s===null&&(e.boundingBox||e.computeBoundingBox(),B_.set(e.boundingBox.min,e.boundingBox.max,n),s=B_),Se(l,o)){let f=t.geometry,u=f.index,h=f.attributes.position,d=e.index,g=e.attributes.position,v=Pe(i,a),m=Be(l,o);if(Tl.copy(n).invert(),e.boundsTree)return ke(i,r,xu),xu.matrix.copy(Tl),xu.needsUpdate=!0,e.boundsTree.shapecast({intersectsBounds:_=>xu.intersectsBox(_),intersectsTriangle:_=>{_.a.applyMatrix4(n),_.b.applyMatrix4(n),_.c.applyMatrix4(n),_.needsUpdate=!0;for(let M=v,y=m+v;M<y;M++)if(Ve(na,3*t.resolveTriangleIndex(M),u,h),na.needsUpdate=!0,_.intersectsTriangle(na))return!0;return!1}});{let p=fr(e);for(let _=v,M=m+v;_<M;_++){let y=t.resolveTriangleIndex(_);Ve(ea,3*y,u,h),ea.a.applyMatrix4(Tl),ea.b.applyMatrix4(Tl),ea.c.applyMatrix4(Tl),ea.needsUpdate=!0;for(let w=0,T=p*3;w<T;w+=3)if(Ve(na,w,d,g),na.needsUpdate=!0,ea.intersectsTriangle(na))return!0}}}else{let f=Ae(i),u=Ee(i,a);return ke(f,r,_u),!!(s.intersectsBox(_u)&&Ip(f,t,e,n,s)||(ke(u,r,_u),s.intersectsBox(_u)&&Ip(u,t,e,n,s)))}}var yu=new te,Lp=new hn,Al=new hn,RT=new U,PT=new U,IT=new U,LT=new U;function k_(i,t,e,n={},s={},r=0,o=1/0){t.boundingBox||t.computeBoundingBox(),Lp.set(t.boundingBox.min,t.boundingBox.max,e),Lp.needsUpdate=!0;let a=i.geometry,l=a.attributes.position,c=a.index,f=t.attributes.position,u=t.index,h=ai.getPrimitive(),d=ai.getPrimitive(),g=RT,v=PT,m=null,p=null;s&&(m=IT,p=LT);let _=1/0,M=null,y=null;return yu.copy(e).invert(),Al.matrix.copy(yu),i.shapecast({boundsTraverseOrder:w=>Lp.distanceToBox(w),intersectsBounds:(w,T,x)=>x<_&&x<o?(T&&(Al.min.copy(w.min),Al.max.copy(w.max),Al.needsUpdate=!0),!0):!1,intersectsRange:(w,T)=>{if(t.boundsTree){let x=t.boundsTree;return x.shapecast({boundsTraverseOrder:b=>Al.distanceToBox(b),intersectsBounds:(b,D,C)=>C<_&&C<o,intersectsRange:(b,D)=>{for(let C=b,P=b+D;C<P;C++){let I=x.resolveTriangleIndex(C);Ve(d,3*I,u,f),d.a.applyMatrix4(e),d.b.applyMatrix4(e),d.c.applyMatrix4(e),d.needsUpdate=!0;for(let O=w,L=w+T;O<L;O++){let z=i.resolveTriangleIndex(O);Ve(h,3*z,c,l),h.needsUpdate=!0;let X=h.distanceToTriangle(d,g,m);if(X<_&&(v.copy(g),p&&p.copy(m),_=X,M=O,y=C),X<r)return!0}}}})}else{let x=fr(t);for(let b=0,D=x;b<D;b++){Ve(d,3*b,u,f),d.a.applyMatrix4(e),d.b.applyMatrix4(e),d.c.applyMatrix4(e),d.needsUpdate=!0;for(let C=w,P=w+T;C<P;C++){let I=i.resolveTriangleIndex(C);Ve(h,3*I,c,l),h.needsUpdate=!0;let O=h.distanceToTriangle(d,g,m);if(O<_&&(v.copy(g),p&&p.copy(m),_=O,M=C,y=b),O<r)return!0}}}}}),ai.releasePrimitive(h),ai.releasePrimitive(d),_===1/0?null:(n.point?n.point.copy(v):n.point=v.clone(),n.distance=_,n.faceIndex=M,s&&(s.point?s.point.copy(p):s.point=p.clone(),s.point.applyMatrix4(yu),v.applyMatrix4(yu),s.distance=v.sub(s.point).length(),s.faceIndex=y),n)}function Dp(i,t,e){return i===null?null:(i.point.applyMatrix4(t.matrixWorld),i.distance=i.point.distanceTo(e.ray.origin),i.object=t,i)}var vu=new hn,Su=new os,V_=new U,G_=new te,H_=new U,Np=["getX","getY","getZ"],Mu=class i extends cu{static serialize(t,e={}){e={cloneBuffers:!0,...e};let n=t.geometry,s=t._roots,r=t._indirectBuffer,o=n.getIndex(),a={version:1,roots:null,index:null,indirectBuffer:null};return e.cloneBuffers?(a.roots=s.map(l=>l.slice()),a.index=o?o.array.slice():null,a.indirectBuffer=r?r.slice():null):(a.roots=s,a.index=o?o.array:null,a.indirectBuffer=r),a}static deserialize(t,e,n={}){n={setIndex:!0,indirect:!!t.indirectBuffer,...n};let{index:s,roots:r,indirectBuffer:o}=t;t.version||(console.warn("MeshBVH.deserialize: Serialization format has been changed and will be fixed up. It is recommended to regenerate any stored serialized data."),l(r));let a=new i(e,{...n,[_l]:!0});if(a._roots=r,a._indirectBuffer=o||null,n.setIndex){let c=e.getIndex();if(c===null){let f=new Je(t.index,1,!1);e.setIndex(f)}else c.array!==s&&(c.array.set(s),c.needsUpdate=!0)}return a;function l(c){for(let f=0;f<c.length;f++){let u=c[f],h=new Uint32Array(u),d=new Uint16Array(u);for(let g=0,v=u.byteLength/32;g<v;g++){let m=8*g,p=2*m;Se(p,d)||(h[m+6]=h[m+6]/8-g)}}}}get primitiveStride(){return 3}get resolveTriangleIndex(){return this.resolvePrimitiveIndex}constructor(t,e={}){e.maxLeafTris&&(console.warn('MeshBVH: "maxLeafTris" option has been deprecated. Use "targetLeafSize", instead.'),e={...e,targetLeafSize:e.maxLeafTris}),super(t,e)}shiftTriangleOffsets(t){return super.shiftPrimitiveOffsets(t)}writePrimitiveBounds(t,e,n){let s=this.geometry,r=this._indirectBuffer,o=s.attributes.position,a=s.index?s.index.array:null,c=(r?r[t]:t)*3,f=c+0,u=c+1,h=c+2;a&&(f=a[f],u=a[u],h=a[h]);for(let d=0;d<3;d++){let g=o[Np[d]](f),v=o[Np[d]](u),m=o[Np[d]](h),p=g;v<p&&(p=v),m<p&&(p=m);let _=g;v>_&&(_=v),m>_&&(_=m),e[n+d]=p,e[n+d+3]=_}return e}computePrimitiveBounds(t,e,n){let s=this.geometry,r=this._indirectBuffer,o=s.attributes.position,a=s.index?s.index.array:null,l=o.normalized;if(t<0||e+t-n.offset>n.length/6)throw new Error("MeshBVH: compute triangle bounds range is invalid.");let c=o.array,f=o.offset||0,u=3;o.isInterleavedBufferAttribute&&(u=o.data.stride);let h=["getX","getY","getZ"],d=n.offset;for(let g=t,v=t+e;g<v;g++){let p=(r?r[g]:g)*3,_=(g-d)*6,M=p+0,y=p+1,w=p+2;a&&(M=a[M],y=a[y],w=a[w]),l||(M=M*u+f,y=y*u+f,w=w*u+f);for(let T=0;T<3;T++){let x,b,D;l?(x=o[h[T]](M),b=o[h[T]](y),D=o[h[T]](w)):(x=c[M+T],b=c[y+T],D=c[w+T]);let C=x;b<C&&(C=b),D<C&&(C=D);let P=x;b>P&&(P=b),D>P&&(P=D);let I=(P-C)/2,O=T*2;n[_+O+0]=C+I,n[_+O+1]=I+(Math.abs(C)+I)*Ho}}return n}raycastObject3D(t,e,n=[]){let{material:s}=t;if(s===void 0)return;G_.copy(t.matrixWorld).invert(),Su.copy(e.ray).applyMatrix4(G_),H_.setFromMatrixScale(t.matrixWorld),V_.copy(Su.direction).multiply(H_);let r=V_.length(),o=e.near/r,a=e.far/r;if(e.firstHitOnly===!0){let l=this.raycastFirst(Su,s,o,a);l=Dp(l,t,e),l&&n.push(l)}else{let l=this.raycast(Su,s,o,a);for(let c=0,f=l.length;c<f;c++){let u=Dp(l[c],t,e);u&&n.push(u)}}return n}refit(t=null){return(this.indirect?U_:A_)(this,t)}raycast(t,e=Mi,n=0,s=1/0){let r=this._roots,o=[],a=this.indirect?F_:P_;for(let l=0,c=r.length;l<c;l++)a(this,l,e,t,o,n,s);return o}raycastFirst(t,e=Mi,n=0,s=1/0){let r=this._roots,o=null,a=this.indirect?O_:I_;for(let l=0,c=r.length;l<c;l++){let f=a(this,l,e,t,n,s);f!=null&&(o==null||f.distance<o.distance)&&(o=f)}return o}intersectsGeometry(t,e){let n=!1,s=this._roots,r=this.indirect?z_:D_;for(let o=0,a=s.length;o<a&&(n=r(this,o,t,e),!n);o++);return n}shapecast(t){let e=ai.getPrimitive(),n=super.shapecast({...t,intersectsPrimitive:t.intersectsTriangle,scratchPrimitive:e,iterate:this.indirect?R_:T_});return ai.releasePrimitive(e),n}bvhcast(t,e,n){let{intersectsRanges:s,intersectsTriangles:r}=n,o=ai.getPrimitive(),a=this.geometry.index,l=this.geometry.attributes.position,c=this.indirect?g=>{let v=this.resolveTriangleIndex(g);Ve(o,v*3,a,l)}:g=>{Ve(o,g*3,a,l)},f=ai.getPrimitive(),u=t.geometry.index,h=t.geometry.attributes.position,d=t.indirect?g=>{let v=t.resolveTriangleIndex(g);Ve(f,v*3,u,h)}:g=>{Ve(f,g*3,u,h)};if(r){if(!(t instanceof i))throw new Error('MeshBVH: "intersectsTriangles" callback can only be used with another MeshBVH.');let g=(v,m,p,_,M,y,w,T)=>{for(let x=p,b=p+_;x<b;x++){d(x),f.a.applyMatrix4(e),f.b.applyMatrix4(e),f.c.applyMatrix4(e),f.needsUpdate=!0;for(let D=v,C=v+m;D<C;D++)if(c(D),o.needsUpdate=!0,r(o,f,D,x,M,y,w,T))return!0}return!1};if(s){let v=s;s=function(m,p,_,M,y,w,T,x){return v(m,p,_,M,y,w,T,x)?!0:g(m,p,_,M,y,w,T,x)}}else s=g}return super.bvhcast(t,e,{intersectsRanges:s})}intersectsBox(t,e){return vu.set(t.min,t.max,e),vu.needsUpdate=!0,this.shapecast({intersectsBounds:n=>vu.intersectsBox(n),intersectsTriangle:n=>vu.intersectsTriangle(n)})}intersectsSphere(t){return this.shapecast({intersectsBounds:e=>t.intersectsBox(e),intersectsTriangle:e=>e.intersectsSphere(t)})}closestPointToGeometry(t,e,n={},s={},r=0,o=1/0){return(this.indirect?k_:N_)(this,t,e,n,s,r,o)}closestPointToPoint(t,e={},n=0,s=1/0){return __(this,t,e,n,s)}};var DT=1e-6,bu=class{constructor(t,e){this.body=t,this.tree=new Mu(e,{indirect:!0}),this.found={},t.closed&&(this.positions=gl(t),this.vectors=ap(this.positions,t.triangles),this.triangles=lp(this.positions.length/3,t.triangles))}measure(t,e){let{tree:n,found:s,body:r}=this;return n.closestPointToPoint(t,s,0,e*(1+1e-5)+1e-9),r.closed&&this.isBehind(t)?-s.distance:s.distance}corner(t,e){return e.fromArray(this.positions,3*t)}isBehind(t){let e=this.partOf(this.found),n=new U;for(let s of this.facesOf(e)){let r=e.length===1?this.angleAt(e[0],s):1;n.addScaledVector(new U().fromArray(this.vectors,s).normalize(),r)}return t.clone().sub(this.found.point).dot(n)<0}facesOf(t){return t.length===3?[3*this.found.faceIndex]:this.triangles[t[0]].filter(e=>t.every(n=>this.cornersOf(e).includes(n)))}cornersOf(t){return this.body.triangles.subarray(t,t+3)}partOf({point:t,faceIndex:e}){let n=this.cornersOf(3*e),[s,r,o]=Array.from(n,l=>this.corner(l,new U)),a=kn.getBarycoord(t,s,r,o,new U);return a?n.filter((l,c)=>a.getComponent(c)>DT):n}angleAt(t,e){let[n,s]=Array.from(this.cornersOf(e)).filter(r=>r!==t).map(r=>this.corner(r,new U).sub(this.corner(t,new U)));return n.angleTo(s)}};var Ur=1024,Up=[.25,.02,0],NT=16,wu=1e9,Tu=class{constructor(t,e,n){Object.assign(this,{points:t,scale:e,measure:n}),this.count=t.length/3,this.known=new Float32Array(Ur*Math.ceil(this.count/Ur)).fill(e.far),this.texture=new wr(this.known,Ur,this.known.length/Ur,Fo,ui),this.texture.needsUpdate=!0,this.places=new Float64Array(t.length).fill(wu),this.pose=new te,this.now=new U,this.latest={place:new U(wu,wu,wu),distance:e.far},this.next=0,this.begin()}begin(){this.pass=0,this.left=this.count}get settled(){return this.pass===Up.length}advance(t,e){let n=performance.now()+e,s=t.equals(this.pose);s||(this.pose.copy(t),this.begin());let r=Up.length-(s?0:1),o=!1;for(;this.pass<r&&performance.now()<n;)o=this.renewSome()||o;return o&&(this.texture.needsUpdate=!0),o}renewSome(){let t=!1;for(let e=0;e<NT&&!this.settled;++e)t=this.renew(this.next)||t,this.next=(this.next+1)%this.count,!(--this.left>0)&&(this.pass+=1,this.left=this.count);return t}renew(t){let{now:e,known:n,scale:{far:s,near:r},latest:o}=this;e.fromArray(this.points,3*t).applyMatrix4(this.pose);let a=this.distanceTo(this.places,3*t),l=Math.abs(n[t]);if(a<=Up[this.pass]*(l+r)||l-a>s)return!1;let c=e.distanceTo(o.place);return Math.abs(o.distance)-c<=s&&(o.distance=this.measure(e,Math.min(l+a,Math.abs(o.distance)+c)),o.place.copy(e)),n[t]=o.distance,o.place.toArray(this.places,3*t),!0}distanceTo(t,e){let{x:n,y:s,z:r}=this.now,[o,a,l]=[n-t[e],s-t[e+1],r-t[e+2]];return Math.sqrt(o*o+a*a+l*l)}};var UT=4;function W_({low:i,high:t}){return Math.max(...t.map((e,n)=>e-i[n]))}function FT(i,t,e,n){i.onBeforeCompile=s=>{Object.assign(s.uniforms,{distances:{value:t},near:{value:e.near},far:{value:e.far},tolerance:{value:n},colours:{value:e.colours},inside:{value:new $t(Qh)}}),s.vertexShader=s.vertexShader.replace("#include <common>",`#include <common>
      uniform highp sampler2D distances;
      attribute float vertex;
      varying float surfaceDistance;`).replace("#include <begin_vertex>",`#include <begin_vertex>
      int texel = int(vertex);
      surfaceDistance = texelFetch(distances, ivec2(texel % ${Ur}, texel / ${Ur}), 0).r;`);let r=e.colours.length-1;s.fragmentShader=s.fragmentShader.replace("#include <common>",`#include <common>
      uniform float near, far, tolerance;
      uniform vec3 colours[${r+1}], inside;
      varying float surfaceDistance;`).replace("#include <color_fragment>",`
      float place = log(1.0 + max(surfaceDistance, 0.0) / near) / log(1.0 + far / near) * ${r}.0;
      int stop = min(int(place), ${r-1});
      diffuseColor.rgb = surfaceDistance < -tolerance ? inside :
        mix(colours[stop], colours[stop + 1], min(place - float(stop), 1.0));`).replace("#include <emissivemap_fragment>",`
      totalEmissiveRadiance += 0.3 * diffuseColor.rgb;`)}}var Au=class{constructor(t){this.picture=t,this.on=!1,this.scale=new jh(hp(.1*t.size)),this.isSigned=t.data.still.closed}make(){let{picture:{data:t,still:e,motions:n},scale:s}=this,r=new bu(t.still,e.surface.geometry),o=(f,u)=>r.measure(f,u),{geometry:a,points:l}=e_(t.moving,n[0].surface.geometry,this.picture.size),c=(W_(t.still)+W_(t.moving))/65535;this.motions=n.map(f=>{let u=new Tu(l,s,o);return f.addColoured(a,h=>FT(h,u.texture,s,c)),u})}setOn(t){this.on=t,t&&!this.motions&&this.make();for(let e of this.picture.motions)e.showColoured(t);this.picture.invalidate()}advance(){if(!this.on)return!1;let{motions:t}=this.picture;return this.motions.map((n,s)=>(t[s].godObject.updateMatrix(),n.advance(t[s].godObject.matrix,UT/t.length))).includes(!0)}};function Fp(i){return new U(...i.high).distanceTo(new U(...i.low))}var Eu=class{constructor(t,e,{count:n,largest:s,lowest:r,smoothEdges:o}){this.data=t,this.canvas=e,this.renderer=new Uh({canvas:e,antialias:o,alpha:!0,stencil:!0}),this.renderer.localClippingEnabled=!0,this.setSharpness(1),this.renderer.setScissorTest(!0),this.renderer.autoClear=!1,this.up=t.up,this.target=new U(...t.camera.target),this.eye=new U(...t.camera.eye),this.distance=this.eye.distanceTo(this.target);let a=2*this.distance*Math.sin(t.camera.half_view);this.cut=new Kh,this.stage=new Jh(t,a,r),this.size=Math.min(Fp(t.moving),a),this.makeBodies(n,s,4*(Fp(t.still)+a)),this.colours=new Au(this),this.camera=new ii(35,1,.01*this.distance,50*this.distance+4*Fp(t.still)),this.columns=1,this.resetView()}makeBodies(t,e,n){let{data:s,cut:r,stage:o,size:a}=this,l={length:.55*a,radius:.25*a,...e};this.still=new Zh(cp(s.still),s.still.closed,r,n);let c=cp(s.moving);this.motions=Array.from({length:t},(f,u)=>new $h(s.moving,c,ds[u],r,l,n)),o.scene.add(this.still,...this.motions)}setUp(t){this.up=t;let e=this.eye.clone().sub(this.target);t!==this.data.up&&(e.setScalar(.35*this.distance).setComponent((t+1)%3,.8*this.distance),e.setLength(this.distance)),this.place(e)}resetView(){this.setUp(this.up)}place(t){this.controls?.dispose(),this.camera.up.set(0,0,0).setComponent(this.up,1);let n=(this.motions.length>1?1.02:.9)*Math.max(1,1/Math.max(this.camera.aspect,.3))**.85;this.camera.position.copy(this.target).addScaledVector(t,n),this.controls=new Wh(this.camera,this.canvas),this.controls.target.copy(this.target),this.controls.enableDamping=!1,this.controls.minDistance=.02*this.distance,this.controls.maxDistance=12*this.distance,this.controls.addEventListener("change",()=>this.invalidate()),this.controls.update(),this.stage.setGround(this.up,this.target,this.dark),this.invalidate()}setDark(t){this.dark=t,this.stage.setGround(this.up,this.target,t),this.invalidate()}setCut({on:t,both:e,axis:n,position:s}){Object.assign(this.cut,{on:t,both:e}),this.cutAxis=n,this.cutPosition=s,this.still.refresh();for(let r of this.motions)r.refresh();this.invalidate()}setFollow(t){this.follows=t}extent(t){return[this.data.still.low[t],this.data.still.high[t]]}invalidate(){this.stale=!0}show(t){this.motions.forEach((n,s)=>n.show(t[s]));let e=this.motions[0].place();if(this.follows){let n=e.clone().sub(this.shownPlace);this.camera.position.add(n),this.controls.target.add(n),this.controls.update()}this.shownPlace=e,this.invalidate()}resize(){let{clientWidth:t,clientHeight:e}=this.canvas.parentElement;if(!t||!e)return;let n=this.motions.length,s=this.camera.aspect;this.columns=t>e*.9?n:1,this.renderer.setSize(t,e,!1),this.camera.aspect=t/this.columns/(e/(n/this.columns));let r=Math.tan(this.data.camera.half_view);this.camera.fov=360/Math.PI*Math.atan(r),this.camera.updateProjectionMatrix(),(!this.sized||Math.abs(s-this.camera.aspect)>.3)&&this.resetView(),this.sized=!0,this.invalidate()}views(){let{clientWidth:t,clientHeight:e}=this.canvas.parentElement,n=this.motions.length/this.columns;return this.motions.map((s,r)=>({left:r%this.columns*t/this.columns,top:Math.floor(r/this.columns)*e/n,width:t/this.columns,height:e/n}))}setSharpness(t){let e=t*Math.min(devicePixelRatio,2);e!==this.renderer.getPixelRatio()&&(this.renderer.setPixelRatio(e),this.invalidate())}draw(){if(!this.colours.advance()&&!this.stale)return;this.stale=!1;let{camera:t,renderer:e,stage:n}=this;this.cut.on&&this.cut.place(this.cutAxis,this.cutPosition,t.position.clone().sub(this.controls.target)),n.light(t,this.controls.target,this.up);let s=this.canvas.parentElement.clientHeight;this.views().forEach((r,o)=>{this.motions.forEach((l,c)=>l.visible=o===c);let a=s-r.top-r.height;e.setViewport(r.left,a,r.width,r.height),e.setScissor(r.left,a,r.width,r.height),e.clear(),e.render(n.scene,t)})}};var OT=/swiftshader|llvmpipe|softpipe|basic render/i;function BT(){let i=document.createElement("canvas").getContext("webgl2");if(!i)return{exists:!1};let t=i.getExtension("WEBGL_debug_renderer_info"),e=i.getParameter(t?t.UNMASKED_RENDERER_WEBGL:i.RENDERER);return i.getExtension("WEBGL_lose_context")?.loseContext(),{exists:!0,isSoftware:OT.test(e)}}function Cu(i,t,e){let{exists:n,isSoftware:s}=BT();if(!n){t.append(mt("p",{className:"message"},"The 3D picture needs WebGL 2, which this browser does not offer. Allow hardware acceleration, or open the page in another browser. The plots work without it."));return}let r=mt("canvas",{className:"picture","aria-label":"The bodies in 3D"});return t.append(r),new Eu(i,r,{...e,smoothEdges:!s})}function Ru(i,t,e,n){let s=()=>{i.resize(),t.place(i.views())};new ResizeObserver(s).observe(e),s(),n.onChange(()=>i.setDark(n.dark)),i.setDark(n.dark)}function Pu(i){let t,e=n=>{i(Math.min((n-(t??n))/1e3,.25)),t=n,requestAnimationFrame(e)};requestAnimationFrame(e)}function zT(i){return`${+(1e3*i).toPrecision(3)}`}function X_({scale:i,isSigned:t},e){let n=i.ticks(),s=mt("div",{className:"scale"},...n.map((o,a)=>{let l=a===n.length-1,c=mt("span",{},`${l?"≥ ":""}${zT(o)}${l?" mm":""}`);return c.style.left=`${100*i.share(o)}%`,c})),r=mt("span",{className:"inside-mark"},"inside");return r.style.setProperty("--inside",Qh),mt("div",{className:"legend",title:`Distance of the god object to the surface of ${e}`},t?r:mt("span",{className:"sides"},"either side"),s)}var kT={play:"M7 4v16l13-8z",pause:"M6 4h4v16H6zM14 4h4v16h-4z",back:"M18 5v14L8 12zM5 5h2v14H5z",forward:"M6 5v14l10-7zM17 5h2v14h-2z",loop:"M7 7h10v3l4-4-4-4v3H5v6h2zM17 17H7v-3l-4 4 4 4v-3h12v-6h-2z",full:"M4 4h6v2H6v4H4zM14 4h6v6h-2V6h-4zM4 14h2v4h4v2H4zM18 14h2v6h-6v-2h4z",theme:"M12 3a9 9 0 1 0 0 18zM12 3a9 9 0 0 1 0 18v-2a7 7 0 0 0 0-14z",reset:"M12 5V2L7 6l5 4V7a5 5 0 1 1-5 5H5a7 7 0 1 0 7-7z"};function Op(i){let t="http://www.w3.org/2000/svg",e=document.createElementNS(t,"svg");e.setAttribute("viewBox","0 0 24 24"),e.setAttribute("aria-hidden","true");let n=document.createElementNS(t,"path");return n.setAttribute("d",kT[i]),e.append(n),e}var Fr=[.1,.25,.5,1,2];function q_(i){return Fr.filter(t=>t>.2&&t<=1&&i/t>=8).at(-1)??.25}function dr(i,t,e){let n=mt("button",{type:"button",title:t,"aria-label":t,onclick:e});return n.append(Op(i)),n}var Iu=class{constructor(t,e){this.clock=t,this.play=dr("play","Play or pause (space)",()=>t.toggle()),this.play.classList.add("play"),this.loop=dr("loop","Play again at the end (l)",()=>this.toggleLoop()),this.scrub=mt("input",{type:"range",min:0,max:t.last,step:1,value:0,"aria-label":"Time",oninput:()=>t.seekSample(this.scrub.valueAsNumber)}),this.time=mt("output",{className:"time"}),this.speed=mt("select",{title:"Speed (arrow up, arrow down)","aria-label":"Speed",onchange:()=>t.setSpeed(+this.speed.value)},...Fr.map(s=>mt("option",{value:String(s)},`${s}×`)));let n=t.times[t.last].toFixed(3);this.end=mt("span",{className:"end"},` / ${n} s`),this.root=mt("div",{className:"transport"},this.play,dr("back","One cycle back (arrow left)",()=>t.step(-1)),dr("forward","One cycle on (arrow right)",()=>t.step(1)),mt("div",{className:"track"},e,this.scrub),mt("span",{className:"times"},this.time,this.end),this.speed,this.loop),t.onChange(()=>this.show())}toggleLoop(){this.clock.loops=!this.clock.loops,this.loop.classList.toggle("on",this.clock.loops),this.loop.setAttribute("aria-pressed",String(this.clock.loops))}changeSpeed(t){let e=Fr.indexOf(this.clock.speed)+t;e>=0&&e<Fr.length&&this.clock.setSpeed(Fr[e])}show(){let{clock:t}=this;this.playing!==t.playing&&(this.playing=t.playing,this.play.replaceChildren(Op(t.playing?"pause":"play"))),this.scrub.value=t.sample,this.time.textContent=t.times[t.sample].toFixed(3),this.speed.value=String(t.speed)}};var Bp=["x","y","z"];function El(i,t,e){let n=mt("input",{type:"checkbox",onchange:()=>e(n.checked)});return{input:n,label:mt("label",{title:t},n,` ${i}`)}}function Y_(i,t,e,n){let s=mt("select",{title:i,"aria-label":i,onchange:()=>n(+s.value)},...t.map((r,o)=>mt("option",{value:String(o)},r)));return s.value=String(e),s}var ia=class{constructor(t,e,n){this.picture=t,this.frame=n,this.root=mt("div",{className:"options"}),t&&this.addPictureOptions(),this.boxes=mt("span",{className:"boxes"}),this.root.append(this.boxes);let s=mt("span",{className:"right"});this.right=s,t&&s.append(dr("reset","Reset the view (r)",()=>t.resetView())),document.fullscreenEnabled&&s.append(dr("full","Full screen (f)",()=>this.toggleFull())),s.append(dr("theme","Light or dark (d)",()=>e.toggle())),this.root.append(s)}addPictureOptions(){let{picture:t}=this;this.follow=El("Follow","Move the camera with the god object",o=>t.setFollow(o)),this.cut=El("Cut","Cut the bodies open towards the eye (c)",()=>this.applyCut()),this.both=El("both bodies","Cut the moving body, too",()=>this.applyCut());let e=t.eye.clone().sub(t.target),n=Bp.map((o,a)=>a===t.up?-1:Math.abs(e.getComponent(a)));this.axis=n.indexOf(Math.max(...n)),this.axisChoice=Y_("Axis across the cut",Bp,this.axis,o=>this.setAxis(o)),this.slider=mt("input",{type:"range",min:0,max:1e3,"aria-label":"Place of the cut",oninput:()=>this.applyCut()}),this.place=mt("output",{className:"place"}),this.details=mt("span",{className:"details own-keys"},this.axisChoice,this.slider,this.place,this.both.label),this.distance=El("Distance","Colour the god object by its distance to the still body (m)",o=>this.showDistance(o)),this.legend=X_(t.colours,t.data.still.name),this.frame.style.setProperty("--scale",t.colours.scale.gradient()),this.legend.hidden=!0;let s=Bp.map(o=>`${o} up`),r=Y_("Axis that points up",s,t.up,o=>t.setUp(o));this.root.append(this.follow.label,this.cut.label,this.details,this.distance.label,this.legend,r),this.setAxis(this.axis)}addBox(t,e,n){let{input:s,label:r}=El(t,e,n);return this.boxes.append(r),s}addButton(t,e){this.right.prepend(mt("button",{type:"button",className:"text",onclick:e},t))}setAxis(t){this.axis=t,this.axisChoice.value=String(t);let[e,n]=this.picture.extent(t),s=this.picture.motions[0].place().getComponent(t);this.slider.value=String(Math.round(1e3*(s-e)/(n-e||1))),this.applyCut()}cutAcross(t,e){this.cut.input.checked=!0,this.both.input.checked=e,this.setAxis(t)}toggleCut(){this.cut.input.checked=!this.cut.input.checked,this.setAxis(this.axis)}applyCut(){let[t,e]=this.picture.extent(this.axis),n=t+this.slider.valueAsNumber/1e3*(e-t);this.place.textContent=`${yr(1e3*n,1)} mm`,this.details.hidden=!this.cut.input.checked,this.picture.setCut({on:this.cut.input.checked,both:this.both.input.checked,axis:this.axis,position:n})}showDistance(t){this.distance.input.checked=t,this.legend.hidden=!t,this.frame.classList.toggle("by-distance",t),this.picture.colours.setOn(t)}toggleFull(){document.fullscreenElement?document.exitFullscreen():this.frame.requestFullscreen()}};function VT(){return`${location.protocol==="https:"?"wss":"ws"}://${location.host}/socket${location.search}`}var Lu=class{constructor(){this.online=void 0,setInterval(()=>this.online&&performance.now()-this.heard>3e3&&this.setOnline(!1),500)}open(){this.socket=new WebSocket(VT(),"godobject-live"),this.socket.addEventListener("message",({data:t})=>this.receive(JSON.parse(t))),this.socket.addEventListener("close",()=>{this.setOnline(!1),setTimeout(()=>this.open(),1e3)})}receive(t){t.type==="answer"&&this.onAnswer(t),t.type==="state"&&(this.heard=performance.now(),this.setOnline(!0),this.onState(t))}setOnline(t){this.online!==t&&(this.online=t,this.onChange(t))}send(t){this.socket.readyState===WebSocket.OPEN&&this.socket.send(JSON.stringify(t))}};var Z_=[[33,1],[66,1],[130,1],[200,.8],[200,.65],[200,.5]],Du=class{constructor(t,e){this.picture=t,this.plots=e,this.level=0,this.patience=4,this.restart()}restart(){this.time=0,this.pictures=0}advance(t){if(this.time+=t,this.pictures+=1,this.time<1)return;let e=1e3*this.time/this.pictures;this.restart(),this.fastMeans=e<20?(this.fastMeans??0)+1:0,e>35&&this.level<Z_.length-1?(this.patience*=2,this.choose(this.level+1)):this.fastMeans>=this.patience&&this.level>0&&this.choose(this.level-1)}choose(t){this.level=t,this.fastMeans=0;let[e,n]=Z_[t];this.plots.interval=e,this.picture?.setSharpness(n)}};var GT=Math.PI,HT=4e-4,WT=14;function Or(i){return[[1,0,0],[0,1,0],[0,0,-1]].map(t=>new U(...t).applyQuaternion(i.quaternion))}var Nu=class{constructor(t,e,n,s){this.picture=t,this.hand=e,this.mayGrab=s,this.pointers=new Map,this.others=new Set,this.raycaster=new Qa;let r={pointerdown:o=>this.down(o),pointermove:o=>this.moved(o),pointerup:o=>this.up(o),pointercancel:o=>this.up(o)};for(let[o,a]of Object.entries(r))n.addEventListener(o,a,{capture:!0});addEventListener("wheel",o=>this.wheel(o),{capture:!0,passive:!1}),t.canvas.addEventListener("contextmenu",o=>o.preventDefault())}pointAt(t,e,n){let{canvas:s,camera:r,motions:[o],still:a}=this.picture,l=s.getBoundingClientRect(),c=[o.surface,...o.ghost.visible?[o.ghost.surface]:[]];for(let[f,u]of[[0,0],...n?[[1,0],[-1,0],[0,1],[0,-1]]:[]]){let h=new kt(2*(t+n*f-l.left)/l.width-1,1-2*(e+n*u-l.top)/l.height);this.raycaster.setFromCamera(h,r);let[d]=this.raycaster.intersectObjects(c,!1);if(!d)continue;let[g]=this.picture.cut.on?[]:this.raycaster.intersectObject(a.surface,!1);if(!g||g.distance>d.distance)return d.point}}down(t){if(!(t.target!==this.picture.canvas||t.pointerType==="mouse"&&t.button!==0)){if(this.pointers.size===0){let n=t.pointerType==="touch"?WT:0,s=this.others.size||!this.mayGrab()?void 0:this.pointAt(t.clientX,t.clientY,n);if(!s){this.others.add(t.pointerId);return}this.hand.grab("pointer"),this.point=this.onDevice(s)}t.stopImmediatePropagation(),t.preventDefault(),this.picture.canvas.setPointerCapture(t.pointerId),this.pointers.set(t.pointerId,new kt(t.clientX,t.clientY))}}onDevice(t){let{place:e,turn:n}=this.hand.device;return t.clone().sub(e).applyQuaternion(n.clone().invert())}band(){if(!(!this.pointers.size||this.hand.holder!=="pointer"))return[this.hand.device,this.hand.target].map(({place:t,turn:e})=>this.point.clone().applyQuaternion(e).add(t))}moved(t){let e=this.pointers.get(t.pointerId);if(!e){this.hover(t);return}t.stopImmediatePropagation();let n=new kt(t.clientX,t.clientY);this.hand.holder==="pointer"&&(this.pointers.size>1?this.pinch(t.pointerId,e,n):t.shiftKey?this.turn(n.clone().sub(e)):t.altKey||t.ctrlKey||t.metaKey?this.twist(this.centreInWindow(),e,n):this.shift(n.clone().sub(e))),this.pointers.set(t.pointerId,n)}up(t){this.others.delete(t.pointerId),this.pointers.delete(t.pointerId)&&(t.stopImmediatePropagation(),this.pointers.size||this.hand.release())}wheel(t){if(!this.pointers.size)return;t.stopImmediatePropagation(),t.preventDefault();let e=t.deltaMode===1?30:1;this.nearer(Math.min(Math.max(t.deltaY*e*HT,-.1),.1))}hover(t){if(t.pointerType!=="mouse"||t.buttons||performance.now()-(this.lookedAt??0)<50)return;this.lookedAt=performance.now();let e=t.target===this.picture.canvas&&this.mayGrab()&&!!this.pointAt(t.clientX,t.clientY,0);e!==this.over&&(this.over=e,this.picture.canvas.classList.toggle("over-body",e),this.picture.motions[0].highlight(e),this.picture.invalidate())}depth(){let t=Or(this.picture.camera)[2],{near:e}=this.picture.camera;return Math.max(this.hand.wanted.place.clone().sub(this.picture.camera.position).dot(t),e)}shift({x:t,y:e}){let{camera:n,canvas:s}=this.picture,[r,o]=Or(n),a=2*this.depth()*Math.tan(n.fov*Math.PI/360)/s.clientHeight;this.hand.move(r.multiplyScalar(t*a).addScaledVector(o,-e*a))}turn({x:t,y:e}){let[n,s]=Or(this.picture.camera),r=GT/this.picture.canvas.clientHeight;this.hand.rotate(s,t*r),this.hand.rotate(n,e*r)}twist(t,e,n){let[s,r]=[e,n].map(a=>a.clone().sub(t)),o=Math.max(s.length()*r.length(),900);this.hand.rotate(Or(this.picture.camera)[2],s.cross(r)/o)}nearer(t){let e=Or(this.picture.camera)[2].negate();this.hand.move(e.multiplyScalar(t*this.depth()))}pinch(t,e,n){let[s]=[...this.pointers].filter(([o])=>o!==t).map(([,o])=>o);this.shift(n.clone().sub(e).multiplyScalar(.5)),this.twist(s,e,n);let r=n.distanceTo(s)/Math.max(e.distanceTo(s),20);this.nearer(Math.min(Math.max(1-1/r,-.1),.1))}centreInWindow(){let{camera:t,canvas:e}=this.picture,{x:n,y:s}=this.hand.target.place.clone().project(t),r=e.getBoundingClientRect();return new kt(r.left+(n+1)/2*r.width,r.top+(1-s)/2*r.height)}};var XT=60,qT=250,YT=1.5,$_=1.2,ZT=6,$T=10,Uu=class{constructor(t,e,n){this.centre=t,this.size=e,this.send=n,this.wanted={place:new U,turn:new en},this.target={place:new U,turn:new en},this.device={place:new U,turn:new en},this.onGrab=()=>{}}follow([t,e,n,s,r,o,a]){this.device.turn.set(r,o,a,s).normalize(),this.device.place.copy(this.centre).applyQuaternion(this.device.turn).add(new U(t,e,n))}grab(t){this.holder=t;for(let e of[this.wanted,this.target])e.place.copy(this.device.place),e.turn.copy(this.device.turn);this.sentAt=0,this.steppedAt=performance.now(),clearInterval(this.timer),this.timer=setInterval(()=>this.step(),1e3/XT),this.onGrab()}move(t){this.wanted.place.add(t)}rotate(t,e){this.wanted.turn.premultiply(new en().setFromAxisAngle(t,e)).normalize();let n=this.wanted.turn.angleTo(this.device.turn);n>$_&&this.wanted.turn.copy(this.device.turn.clone().slerp(this.wanted.turn,$_/n))}step(){let t=performance.now(),e=Math.min((t-this.steppedAt)/1e3,.1);this.steppedAt=t;let{target:n,wanted:s,device:r,size:o}=this,a=this.pose(),l=s.place.clone().sub(r.place).clampLength(0,YT*o).add(r.place);n.place.add(l.sub(n.place).clampLength(0,ZT*o*e)),n.turn.rotateTowards(s.turn,$T*e);let c=this.pose();t-this.sentAt<qT&&c.every((f,u)=>Math.abs(f-a[u])<1e-7)||(this.sentAt=t,this.send({type:"hand",pose:c}))}pose(){let{place:t,turn:e}=this.target,{x:n,y:s,z:r}=this.centre.clone().applyQuaternion(e).negate().add(t);return[n,s,r,e.w,e.x,e.y,e.z]}release(){this.holder&&(this.drop(),this.send({type:"release"}))}drop(){clearInterval(this.timer),this.holder=void 0}};var KT=[["Drag","turn the camera; right button: pan; wheel: zoom"],["c  m","cut, colour by distance"],["r  f  d","reset the view, full screen, dark or light"],["a  h","arm, this help"]],JT=[["Drag the body","move it in the plane of the screen"],["Wheel while dragging","push it away or pull it nearer"],["Shift + drag","turn it about the axes of the screen"],["Alt or Ctrl + drag","twist it about the line of sight"],["Arrow keys","move it; with shift turn it"],["Page up, page down","away and nearer; with shift twist"],["Two fingers on the body","pinch: away and nearer; twist"],["Gamepad","left stick and triggers move, right stick and shoulder buttons turn"]],Fu=class{constructor(t){let e=[...t?JT:[],...KT].flatMap(([n,s])=>[mt("dt",{},n),mt("dd",{},s)]);this.root=mt("div",{className:"help",hidden:!0},mt("dl",{},...e))}toggle(){this.root.hidden=!this.root.hidden}};var jT=new U(0,1,0),gs=class extends Ga{constructor(t,e,n,s){super(t,e,n),this.count=0,this.most=n,this.frustumCulled=!1,this.renderOrder=s}clear(){this.count=0}put(t,e,n,s){if(this.count===this.most)return;let r=new en().setFromUnitVectors(jT,e);this.setMatrixAt(this.count++,new te().compose(t,r,new U(n,s,n))),this.instanceMatrix.needsUpdate=!0}};var K_=16,Ou=class extends dn{constructor(t){super(),this.size=t;let e=new ri({colorWrite:!1,transparent:!0}),n=o=>new cs({color:o,roughness:.5,metalness:.1,transparent:!0,opacity:.4}),s=new Gi(.8,1,1,24).translate(0,.5,0),r=new qa(1,18,10);this.tubes=[e,n(9741240)].map((o,a)=>new gs(s,o,K_,6+a)),this.balls=[e,n(4674921)].map((o,a)=>new gs(r,o,K_,6+a)),this.add(...this.tubes,...this.balls)}show(t){let e=t.map(r=>new U(...r)),n=e.slice(1).reduce((r,o,a)=>r+o.distanceTo(e[a]),0),s=Math.min(.03*n,.1*this.size);for(let r of[...this.tubes,...this.balls])r.clear();e.forEach((r,o)=>{let a=s*(1-.45*o/e.length),l=e[o+1]?.clone().sub(r);if(!(!l||l.length()<1e-6)){for(let c of this.balls)c.put(r,new U(0,1,0),1.25*a,1.25*a);for(let c of this.tubes)c.put(r,l.clone().normalize(),a,l.length())}})}};var Bu=64;function zu(i,t=1){return new ri({color:i,depthTest:!1,depthWrite:!1,transparent:!0,opacity:t})}var ku=class extends dn{constructor(t,e,n){super(),Object.assign(this,{size:t,longest:e,largest:n});let s=new Gi(1,1,1,20);this.rims=new gs(s,zu(1120295),Bu,21),this.discs=new gs(s,zu(16638023),Bu,22),this.shafts=new gs(new Gi(1,1,1,8).translate(0,.5,0),zu(1120295,.85),Bu,22),this.heads=new gs(new Qs(1,1,12).translate(0,.5,0),zu(1120295,.85),Bu,22),this.add(this.rims,this.discs,this.shafts,this.heads)}setDark(t){for(let{material:e}of[this.shafts,this.heads])e.color.set(t?16317180:1120295)}show(t){let{rims:e,discs:n,shafts:s,heads:r,size:o}=this;for(let a of[e,n,s,r])a.clear();for(let[a,l,c,f,u,h,d]of t){let g=new U(a,l,c),v=new U(f,u,h).normalize();e.put(g,v,.018*o,.002*o),n.put(g,v,.012*o,.004*o);let m=Math.min(d/this.largest,1)*this.longest;if(m<.02*o)continue;let p=Math.min(.05*o,.5*m);s.put(g,v,.004*o,m-.9*p),r.put(g.clone().addScaledVector(v,m-p),v,.35*p,p)}}};function QT(){let i=new pn().setFromPoints([new U,new U]),t=new Eo(i,new as({color:11817737,depthTest:!1,transparent:!0}));return t.renderOrder=23,t.frustumCulled=!1,t.visible=!1,t}var Vu=class{constructor(t,e){this.picture=t,this.points=new ku(t.size,.4*t.size,e),this.arm=new Ou(t.size),this.band=QT(),t.stage.scene.add(this.points,this.arm,this.band)}setDark(t){this.points.setDark(t),this.band.material.color.set(t?16498468:11817737)}showArm(t){this.arm.visible=t,this.picture.invalidate()}show({points:t,arm:e}){this.points.show(t),this.arm.show(e),this.picture.invalidate()}showBand(t){!t&&!this.band.visible||(this.band.visible=!!t,t&&this.band.geometry.setFromPoints(t),this.picture.invalidate())}};var tA=5e3,Gu=class{constructor(t){let e=(s,...r)=>mt("div",{className:`notice ${s}`,hidden:!0,role:"status"},...r);this.faultText=mt("span");let n=mt("button",{type:"button",className:"wide",onclick:t},"Reset");this.fault=e("fault",this.faultText,n),this.connection=e("connection"),this.answer=e("answer"),this.hint=e("hint"),this.root=mt("div",{className:"notices"},this.connection,this.fault,this.answer,this.hint)}showFault(t){this.faultText.textContent===t&&this.fault.hidden===!t||(this.faultText.textContent=t,this.fault.hidden=!t)}showConnection(t){this.connection.textContent=t,this.connection.hidden=!t}showHint(t){this.hint.textContent=t,this.hint.hidden=!t}tell(t){this.answer.textContent=t,this.answer.hidden=!1,clearTimeout(this.timer),this.timer=setTimeout(()=>this.answer.hidden=!0,tA)}};var eA="uplot",nA="u-hz",iA="u-vt",sA="u-title",rA="u-wrap",oA="u-under",aA="u-over",lA="u-axis",kr="u-off",cA="u-select",hA="u-cursor-x",uA="u-cursor-y",fA="u-cursor-pt",dA="u-legend",pA="u-live",mA="u-inline",gA="u-series",_A="u-marker",J_="u-label",xA="u-value",Rl="width",Pl="height";var j_="bottom",sa="left",zp="right",nm="#000",Q_=nm+"0",kp="mousemove",tx="mousedown",Vp="mouseup",ex="mouseenter",nx="mouseleave",ix="dblclick",yA="resize",vA="scroll",sx="change",Yu="dppxchange",im="--",ua=typeof window<"u",qp=ua?document:null,oa=ua?window:null,SA=ua?navigator:null,Ce,Hu;function Yp(){let i=devicePixelRatio;Ce!=i&&(Ce=i,Hu&&$p(sx,Hu,Yp),Hu=matchMedia(`(min-resolution: ${Ce-.001}dppx) and (max-resolution: ${Ce+.001}dppx)`),Vr(sx,Hu,Yp),oa.dispatchEvent(new CustomEvent(Yu)))}function Ti(i,t){if(t!=null){let e=i.classList;!e.contains(t)&&e.add(t)}}function Zp(i,t){let e=i.classList;e.contains(t)&&e.remove(t)}function je(i,t,e){i.style[t]=e+"px"}function Zi(i,t,e,n){let s=qp.createElement(i);return t!=null&&Ti(s,t),e?.insertBefore(s,n),s}function Di(i,t){return Zi("div",i,t)}var rx=new WeakMap;function _s(i,t,e,n,s){let r="translate("+t+"px,"+e+"px)",o=rx.get(i);r!=o&&(i.style.transform=r,rx.set(i,r),t<0||e<0||t>n||e>s?Ti(i,kr):Zp(i,kr))}var ox=new WeakMap;function ax(i,t,e){let n=t+e,s=ox.get(i);n!=s&&(ox.set(i,n),i.style.background=t,i.style.borderColor=e)}var lx=new WeakMap;function cx(i,t,e,n){let s=t+""+e,r=lx.get(i);s!=r&&(lx.set(i,s),i.style.height=e+"px",i.style.width=t+"px",i.style.marginLeft=n?-t/2+"px":0,i.style.marginTop=n?-e/2+"px":0)}var sm={passive:!0},MA={...sm,capture:!0};function Vr(i,t,e,n){t.addEventListener(i,e,n?MA:sm)}function $p(i,t,e,n){t.removeEventListener(i,e,sm)}ua&&Yp();function $i(i,t,e,n){let s;e=e||0,n=n||t.length-1;let r=n<=2147483647;for(;n-e>1;)s=r?e+n>>1:Ai((e+n)/2),t[s]<i?e=s:n=s;return i-t[e]<=t[n]-i?e:n}function Ox(i){return(e,n,s)=>{let r=-1,o=-1;for(let a=n;a<=s;a++)if(i(e[a])){r=a;break}for(let a=s;a>=n;a--)if(i(e[a])){o=a;break}return[r,o]}}var Bx=i=>i!=null,zx=i=>i!=null&&i>0,Ku=Ox(Bx),bA=Ox(zx);function wA(i,t,e,n=0,s=!1){let r=s?bA:Ku,o=s?zx:Bx;[t,e]=r(i,t,e);let a=i[t],l=i[t];if(t>-1)if(n==1)a=i[t],l=i[e];else if(n==-1)a=i[e],l=i[t];else for(let c=t;c<=e;c++){let f=i[c];o(f)&&(f<a?a=f:f>l&&(l=f))}return[a??Ge,l??-Ge]}function Ju(i,t,e,n){let s=fx(i),r=fx(t);i==t&&(s==-1?(i*=e,t/=e):(i/=e,t*=e));let o=e==10?Bs:kx,a=s==1?Ai:Ni,l=r==1?Ni:Ai,c=a(o(Dn(i))),f=l(o(Dn(t))),u=aa(e,c),h=aa(e,f);return e==10&&(c<0&&(u=He(u,-c)),f<0&&(h=He(h,-f))),n||e==2?(i=u*s,t=h*r):(i=Wx(i,u),t=ju(t,h)),[i,t]}function rm(i,t,e,n){let s=Ju(i,t,e,n);return i==0&&(s[0]=0),t==0&&(s[1]=0),s}var om=.1,hx={mode:3,pad:om},Ll={pad:0,soft:null,mode:0},TA={min:Ll,max:Ll};function Zu(i,t,e,n){return Qu(e)?ux(i,t,e):(Ll.pad=e,Ll.soft=n?0:null,Ll.mode=n?3:0,ux(i,t,TA))}function be(i,t){return i??t}function AA(i,t,e){for(t=be(t,0),e=be(e,i.length-1);t<=e;){if(i[t]!=null)return!0;t++}return!1}function ux(i,t,e){let n=e.min,s=e.max,r=be(n.pad,0),o=be(s.pad,0),a=be(n.hard,-Ge),l=be(s.hard,Ge),c=be(n.soft,Ge),f=be(s.soft,-Ge),u=be(n.mode,0),h=be(s.mode,0),d=t-i,g=Bs(d),v=li(Dn(i),Dn(t)),m=Bs(v),p=Dn(m-g);(d<1e-24||p>10)&&(d=0,(i==0||t==0)&&(d=1e-24,u==2&&c!=Ge&&(r=0),h==2&&f!=-Ge&&(o=0)));let _=d||v||1e3,M=Bs(_),y=aa(10,Ai(M)),w=_*(d==0?i==0?.1:1:r),T=He(Wx(i-w,y/10),24),x=i>=c&&(u==1||u==3&&T<=c||u==2&&T>=c)?c:Ge,b=li(a,T<x&&i>=x?x:Ki(x,T)),D=_*(d==0?t==0?.1:1:o),C=He(ju(t+D,y/10),24),P=t<=f&&(h==1||h==3&&C>=f||h==2&&C<=f)?f:-Ge,I=Ki(l,C>P&&t<=P?P:li(P,C));return b==I&&b==0&&(I=100),[b,I]}var EA=new Intl.NumberFormat(ua?SA.language:"en-US"),am=i=>EA.format(i),Ei=Math,qu=Ei.PI,Dn=Ei.abs,Ai=Ei.floor,Ln=Ei.round,Ni=Ei.ceil,Ki=Ei.min,li=Ei.max,aa=Ei.pow,fx=Ei.sign,Bs=Ei.log10,kx=Ei.log2,CA=(i,t=1)=>Ei.sinh(i)*t,Gp=(i,t=1)=>Ei.asinh(i/t),Ge=1/0;function dx(i){return(Bs((i^i>>31)-(i>>31))|0)+1}function Kp(i,t,e){return Ki(li(i,t),e)}function Vx(i){return typeof i=="function"}function ye(i){return Vx(i)?i:()=>i}var RA=()=>{},Gx=i=>i,Hx=(i,t)=>t,PA=i=>null,px=i=>!0,mx=(i,t)=>i==t,IA=/\.\d*?(?=9{6,}|0{6,})/gm,Gr=i=>{if(qx(i)||mr.has(i))return i;let t=`${i}`,e=t.match(IA);if(e==null)return i;let n=e[0].length-1;if(t.indexOf("e-")!=-1){let[s,r]=t.split("e");return+`${Gr(s)}e${r}`}return He(i,n)};function Br(i,t){return Gr(He(Gr(i/t))*t)}function ju(i,t){return Gr(Ni(Gr(i/t))*t)}function Wx(i,t){return Gr(Ai(Gr(i/t))*t)}function He(i,t=0){if(qx(i))return i;let e=10**t,n=i*e*(1+Number.EPSILON);return Ln(n)/e}var mr=new Map;function Xx(i){return((""+i).split(".")[1]||"").length}function Nl(i,t,e,n){let s=[],r=n.map(Xx);for(let o=t;o<e;o++){let a=Dn(o),l=He(aa(i,o),a);for(let c=0;c<n.length;c++){let f=i==10?+`${n[c]}e${o}`:n[c]*l,u=(o>=0?0:a)+(o>=r[c]?0:r[c]),h=i==10?f:He(f,u);s.push(h),mr.set(h,u)}}return s}var Dl={},lm=[],la=[null,null],pr=Array.isArray,qx=Number.isInteger,LA=i=>i===void 0;function gx(i){return typeof i=="string"}function Qu(i){let t=!1;if(i!=null){let e=i.constructor;t=e==null||e==Object}return t}function DA(i){return i!=null&&typeof i=="object"}var NA=Object.getPrototypeOf(Uint8Array),Yx="__proto__";function ca(i,t=Qu){let e;if(pr(i)){let n=i.find(s=>s!=null);if(pr(n)||t(n)){e=Array(i.length);for(let s=0;s<i.length;s++)e[s]=ca(i[s],t)}else e=i.slice()}else if(i instanceof NA)e=i.slice();else if(t(i)){e={};for(let n in i)n!=Yx&&(e[n]=ca(i[n],t))}else e=i;return e}function bn(i){let t=arguments;for(let e=1;e<t.length;e++){let n=t[e];for(let s in n)s!=Yx&&(Qu(i[s])?bn(i[s],ca(n[s])):i[s]=ca(n[s]))}return i}var UA=0,FA=1,OA=2;function BA(i,t,e){for(let n=0,s,r=-1;n<t.length;n++){let o=t[n];if(o>r){for(s=o-1;s>=0&&i[s]==null;)i[s--]=null;for(s=o+1;s<e&&i[s]==null;)i[r=s++]=null}}}function zA(i,t){if(GA(i)){let o=i[0].slice();for(let a=1;a<i.length;a++)o.push(...i[a].slice(1));return HA(o[0])||(o=VA(o)),o}let e=new Set;for(let o=0;o<i.length;o++){let l=i[o][0],c=l.length;for(let f=0;f<c;f++)e.add(l[f])}let n=[Array.from(e).sort((o,a)=>o-a)],s=n[0].length,r=new Map;for(let o=0;o<s;o++)r.set(n[0][o],o);for(let o=0;o<i.length;o++){let a=i[o],l=a[0];for(let c=1;c<a.length;c++){let f=a[c],u=Array(s).fill(void 0),h=t?t[o][c]:FA,d=[];for(let g=0;g<f.length;g++){let v=f[g],m=r.get(l[g]);v===null?h!=UA&&(u[m]=v,h==OA&&d.push(m)):u[m]=v}BA(u,d,s),n.push(u)}}return n}var kA=typeof queueMicrotask>"u"?i=>Promise.resolve().then(i):queueMicrotask;function VA(i){let t=i[0],e=t.length,n=Array(e);for(let r=0;r<n.length;r++)n[r]=r;n.sort((r,o)=>t[r]-t[o]);let s=[];for(let r=0;r<i.length;r++){let o=i[r],a=Array(e);for(let l=0;l<e;l++)a[l]=o[n[l]];s.push(a)}return s}function GA(i){let t=i[0][0],e=t.length;for(let n=1;n<i.length;n++){let s=i[n][0];if(s.length!=e)return!1;if(s!=t){for(let r=0;r<e;r++)if(s[r]!=t[r])return!1}}return!0}function HA(i,t=100){let e=i.length;if(e<=1)return!0;let n=0,s=e-1;for(;n<=s&&i[n]==null;)n++;for(;s>=n&&i[s]==null;)s--;if(s<=n)return!0;let r=li(1,Ai((s-n+1)/t));for(let o=i[n],a=n+r;a<=s;a+=r){let l=i[a];if(l!=null){if(l<=o)return!1;o=l}}return!0}var Zx=["January","February","March","April","May","June","July","August","September","October","November","December"],$x=["Sunday","Monday","Tuesday","Wednesday","Thursday","Friday","Saturday"];function Kx(i){return i.slice(0,3)}var WA=$x.map(Kx),XA=Zx.map(Kx),qA={MMMM:Zx,MMM:XA,WWWW:$x,WWW:WA};function Cl(i){return(i<10?"0":"")+i}function YA(i){return(i<10?"00":i<100?"0":"")+i}var ZA={YYYY:i=>i.getFullYear(),YY:i=>(i.getFullYear()+"").slice(2),MMMM:(i,t)=>t.MMMM[i.getMonth()],MMM:(i,t)=>t.MMM[i.getMonth()],MM:i=>Cl(i.getMonth()+1),M:i=>i.getMonth()+1,DD:i=>Cl(i.getDate()),D:i=>i.getDate(),WWWW:(i,t)=>t.WWWW[i.getDay()],WWW:(i,t)=>t.WWW[i.getDay()],HH:i=>Cl(i.getHours()),H:i=>i.getHours(),h:i=>{let t=i.getHours();return t==0?12:t>12?t-12:t},AA:i=>i.getHours()>=12?"PM":"AM",aa:i=>i.getHours()>=12?"pm":"am",a:i=>i.getHours()>=12?"p":"a",mm:i=>Cl(i.getMinutes()),m:i=>i.getMinutes(),ss:i=>Cl(i.getSeconds()),s:i=>i.getSeconds(),fff:i=>YA(i.getMilliseconds())};function cm(i,t){t=t||qA;let e=[],n=/\{([a-z]+)\}|[^{]+/gi,s;for(;s=n.exec(i);)e.push(s[0][0]=="{"?ZA[s[1]]:s[0]);return r=>{let o="";for(let a=0;a<e.length;a++)o+=typeof e[a]=="string"?e[a]:e[a](r,t);return o}}var $A=new Intl.DateTimeFormat().resolvedOptions().timeZone;function KA(i,t){let e;return t=="UTC"||t=="Etc/UTC"?e=new Date(+i+i.getTimezoneOffset()*6e4):t==$A?e=i:(e=new Date(i.toLocaleString("en-US",{timeZone:t})),e.setMilliseconds(i.getMilliseconds())),e}var Jx=i=>i%1==0,$u=[1,2,2.5,5],JA=Nl(10,-32,0,$u),jx=Nl(10,0,32,$u),jA=jx.filter(Jx),zr=JA.concat(jx),hm=`
`,Qx="{YYYY}",_x=hm+Qx,ty="{M}/{D}",Il=hm+ty,Wu=Il+"/{YY}",ey="{aa}",QA="{h}:{mm}",ra=QA+ey,xx=hm+ra,yx=":{ss}",Ie=null;function ny(i){let t=i*1e3,e=t*60,n=e*60,s=n*24,r=s*30,o=s*365,l=(i==1?Nl(10,0,3,$u).filter(Jx):Nl(10,-3,0,$u)).concat([t,t*5,t*10,t*15,t*30,e,e*5,e*10,e*15,e*30,n,n*2,n*3,n*4,n*6,n*8,n*12,s,s*2,s*3,s*4,s*5,s*6,s*7,s*8,s*9,s*10,s*15,r,r*2,r*3,r*4,r*6,o,o*2,o*5,o*10,o*25,o*50,o*100]),c=[[o,Qx,Ie,Ie,Ie,Ie,Ie,Ie,1],[s*28,"{MMM}",_x,Ie,Ie,Ie,Ie,Ie,1],[s,ty,_x,Ie,Ie,Ie,Ie,Ie,1],[n,"{h}"+ey,Wu,Ie,Il,Ie,Ie,Ie,1],[e,ra,Wu,Ie,Il,Ie,Ie,Ie,1],[t,yx,Wu+" "+ra,Ie,Il+" "+ra,Ie,xx,Ie,1],[i,yx+".{fff}",Wu+" "+ra,Ie,Il+" "+ra,Ie,xx,Ie,1]];function f(u){return(h,d,g,v,m,p)=>{let _=[],M=m>=o,y=m>=r&&m<o,w=u(g),T=He(w*i,3),x=Hp(w.getFullYear(),M?0:w.getMonth(),y||M?1:w.getDate()),b=He(x*i,3);if(y||M){let D=y?m/r:0,C=M?m/o:0,P=T==b?T:He(Hp(x.getFullYear()+C,x.getMonth()+D,1)*i,3),I=new Date(Ln(P/i)),O=I.getFullYear(),L=I.getMonth();for(let z=0;P<=v;z++){let X=Hp(O+C*z,L+D*z,1),H=X-u(He(X*i,3));P=He((+X+H)*i,3),P<=v&&_.push(P)}}else{let D=m>=s?s:m,C=Ai(g)-Ai(T),P=b+C+ju(T-b,D);_.push(P);let I=u(P),O=I.getHours()+I.getMinutes()/e+I.getSeconds()/n,L=m/n,z=h.axes[d]._space,X=p/z;for(;P=He(P+m,i==1?0:3),!(P>v);)if(L>1){let H=Ai(He(O+L,6))%24,j=u(P).getHours()-H;j>1&&(j=-1),P-=j*n,O=(O+L)%24;let nt=_[_.length-1];He((P-nt)/m,3)*X>=.7&&_.push(P)}else _.push(P)}return _}}return[l,c,f]}var[tE,eE,nE]=ny(1),[iE,sE,rE]=ny(.001);Nl(2,-53,53,[1]);function vx(i,t){return i.map(e=>e.map((n,s)=>s==0||s==8||n==null?n:t(s==1||e[8]==0?n:e[1]+n)))}function Sx(i,t){return(e,n,s,r,o)=>{let a=t.find(g=>o>=g[0])||t[t.length-1],l,c,f,u,h,d;return n.map(g=>{let v=i(g),m=v.getFullYear(),p=v.getMonth(),_=v.getDate(),M=v.getHours(),y=v.getMinutes(),w=v.getSeconds(),T=m!=l&&a[2]||p!=c&&a[3]||_!=f&&a[4]||M!=u&&a[5]||y!=h&&a[6]||w!=d&&a[7]||a[1];return l=m,c=p,f=_,u=M,h=y,d=w,T(v)})}}function oE(i,t){let e=cm(t);return(n,s,r,o,a)=>s.map(l=>e(i(l)))}function Hp(i,t,e){return new Date(i,t,e)}function Mx(i,t){return t(i)}var aE="{YYYY}-{MM}-{DD} {h}:{mm}{aa}";function bx(i,t){return(e,n,s,r)=>r==null?im:t(i(n))}function lE(i,t){let e=i.series[t];return e.width?e.stroke(i,t):e.points.width?e.points.stroke(i,t):null}function cE(i,t){return i.series[t].fill(i,t)}var hE={show:!0,live:!0,isolate:!1,mount:RA,markers:{show:!0,width:2,stroke:lE,fill:cE,dash:"solid"},idx:null,idxs:null,values:[]};function uE(i,t){let e=i.cursor.points,n=Di(),s=e.size(i,t);je(n,Rl,s),je(n,Pl,s);let r=s/-2;je(n,"marginLeft",r),je(n,"marginTop",r);let o=e.width(i,t,s);return o&&je(n,"borderWidth",o),n}function fE(i,t){let e=i.series[t].points;return e._fill||e._stroke}function dE(i,t){let e=i.series[t].points;return e._stroke||e._fill}function pE(i,t){return i.series[t].points.size}var Wp=[0,0];function mE(i,t,e){return Wp[0]=t,Wp[1]=e,Wp}function Xu(i,t,e,n=!0){return s=>{s.button==0&&(!n||s.target==t)&&e(s)}}function Xp(i,t,e,n=!0){return s=>{(!n||s.target==t)&&e(s)}}var gE={show:!0,x:!0,y:!0,lock:!1,move:mE,points:{one:!1,show:uE,size:pE,width:0,stroke:dE,fill:fE},bind:{mousedown:Xu,mouseup:Xu,click:Xu,dblclick:Xu,mousemove:Xp,mouseleave:Xp,mouseenter:Xp},drag:{setScale:!0,x:!0,y:!1,dist:0,uni:null,click:(i,t)=>{t.stopPropagation(),t.stopImmediatePropagation()},_x:!1,_y:!1},focus:{dist:(i,t,e,n,s)=>n-s,prox:-1,bias:0},hover:{skip:[void 0],prox:null,bias:0},left:-10,top:-10,idx:null,dataIdx:null,idxs:null,event:null},iy={show:!0,stroke:"rgba(0,0,0,0.07)",width:2},um=bn({},iy,{filter:Hx}),sy=bn({},um,{size:10}),ry=bn({},iy,{show:!1}),fm='12px system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, "Noto Sans", sans-serif, "Apple Color Emoji", "Segoe UI Emoji", "Segoe UI Symbol", "Noto Color Emoji"',oy="bold "+fm,ay=1.5,wx={show:!0,scale:"x",stroke:nm,space:50,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:oy,side:2,grid:um,ticks:sy,border:ry,font:fm,lineGap:ay,rotate:0},_E="Value",xE="Time",Tx={show:!0,scale:"x",auto:!1,sorted:1,min:Ge,max:-Ge,idxs:[]};function yE(i,t,e,n,s){return t.map(r=>r==null?"":am(r))}function vE(i,t,e,n,s,r,o){let a=[],l=mr.get(s)||0;e=o?e:He(ju(e,s),l);for(let c=e;c<=n;c=He(c+s,l))a.push(Object.is(c,-0)?0:c);return a}function Jp(i,t,e,n,s,r,o){let a=[],l=i.scales[i.axes[t].scale].log,c=l==10?Bs:kx,f=Ai(c(e));s=aa(l,f),l==10&&(s=zr[$i(s,zr)]);let u=e,h=s*l;l==10&&(h=zr[$i(h,zr)]);do a.push(u),u=u+s,l==10&&!mr.has(u)&&(u=He(u,mr.get(s))),u>=h&&(s=u,h=s*l,l==10&&(h=zr[$i(h,zr)]));while(u<=n);return a}function SE(i,t,e,n,s,r,o){let l=i.scales[i.axes[t].scale].asinh,c=n>l?Jp(i,t,li(l,e),n,s):[l],f=n>=0&&e<=0?[0]:[];return(e<-l?Jp(i,t,li(l,-n),-e,s):[l]).reverse().map(h=>-h).concat(f,c)}var ly=/./,ME=/[12357]/,bE=/[125]/,Ax=/1/,jp=(i,t,e,n)=>i.map((s,r)=>t==4&&s==0||r%n==0&&e.test(s.toExponential()[s<0?1:0])?s:null);function wE(i,t,e,n,s){let r=i.axes[e],o=r.scale,a=i.scales[o],l=i.valToPos,c=r._space,f=l(10,o),u=l(9,o)-f>=c?ly:l(7,o)-f>=c?ME:l(5,o)-f>=c?bE:Ax;if(u==Ax){let h=Dn(l(1,o)-f);if(h<c)return jp(t.slice().reverse(),a.distr,u,Ni(c/h)).reverse()}return jp(t,a.distr,u,1)}function TE(i,t,e,n,s){let r=i.axes[e],o=r.scale,a=r._space,l=i.valToPos,c=Dn(l(1,o)-l(2,o));return c<a?jp(t.slice().reverse(),3,ly,Ni(a/c)).reverse():t}function AE(i,t,e,n){return n==null?im:t==null?"":am(t)}var Ex={show:!0,scale:"y",stroke:nm,space:30,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:oy,side:3,grid:um,ticks:sy,border:ry,font:fm,lineGap:ay,rotate:0};function EE(i,t){let e=3+(i||1)*2;return He(e*t,3)}function CE(i,t){let{scale:e,idxs:n}=i.series[0],s=i._data[0],r=i.valToPos(s[n[0]],e,!0),o=i.valToPos(s[n[1]],e,!0),a=Dn(o-r),l=i.series[t],c=a/(l.points.space*Ce);return n[1]-n[0]<=c}var Cx={scale:null,auto:!0,sorted:0,min:Ge,max:-Ge},cy=(i,t,e,n,s)=>s,Rx={show:!0,auto:!0,sorted:0,gaps:cy,alpha:1,facets:[bn({},Cx,{scale:"x"}),bn({},Cx,{scale:"y"})]},Px={scale:"y",auto:!0,sorted:0,show:!0,spanGaps:!1,gaps:cy,alpha:1,points:{show:CE,filter:null},values:null,min:Ge,max:-Ge,idxs:[],path:null,clip:null};function RE(i,t,e,n,s){return e/10}var hy={time:!0,auto:!0,distr:1,log:10,asinh:1,min:null,max:null,dir:1,ori:0},PE=bn({},hy,{time:!1,ori:1}),Ix={};function uy(i,t){let e=Ix[i];return e||(e={key:i,plots:[],sub(n){e.plots.push(n)},unsub(n){e.plots=e.plots.filter(s=>s!=n)},pub(n,s,r,o,a,l,c){for(let f=0;f<e.plots.length;f++)e.plots[f]!=s&&e.plots[f].pub(n,s,r,o,a,l,c)}},i!=null&&(Ix[i]=e)),e}var ha=1,Qp=2;function Hr(i,t,e){let n=i.mode,s=i.series[t],r=n==2?i._data[t]:i._data,o=i.scales,a=i.bbox,l=r[0],c=n==2?r[1]:r[t],f=n==2?o[s.facets[0].scale]:o[i.series[0].scale],u=n==2?o[s.facets[1].scale]:o[s.scale],h=a.left,d=a.top,g=a.width,v=a.height,m=i.valToPosH,p=i.valToPosV;return f.ori==0?e(s,l,c,f,u,m,p,h,d,g,v,ef,fa,sf,dy,my):e(s,l,c,f,u,p,m,d,h,v,g,nf,da,mm,py,gy)}function dm(i,t){let e=0,n=0,s=be(i.bands,lm);for(let r=0;r<s.length;r++){let o=s[r];o.series[0]==t?e=o.dir:o.series[1]==t&&(o.dir==1?n|=1:n|=2)}return[e,n==1?-1:n==2?1:n==3?2:0]}function IE(i,t,e,n,s){let r=i.mode,o=i.series[t],a=r==2?o.facets[1].scale:o.scale,l=i.scales[a];return s==-1?l.min:s==1?l.max:l.distr==3?l.dir==1?l.min:l.max:0}function zs(i,t,e,n,s,r){return Hr(i,t,(o,a,l,c,f,u,h,d,g,v,m)=>{let p=o.pxRound,_=c.dir*(c.ori==0?1:-1),M=c.ori==0?fa:da,y,w;_==1?(y=e,w=n):(y=n,w=e);let T=p(u(a[y],c,v,d)),x=p(h(l[y],f,m,g)),b=p(u(a[w],c,v,d)),D=p(h(r==1?f.max:f.min,f,m,g)),C=new Path2D(s);return M(C,b,D),M(C,T,D),M(C,T,x),C})}function tf(i,t,e,n,s,r){let o=null;if(i.length>0){o=new Path2D;let a=t==0?sf:mm,l=e;for(let u=0;u<i.length;u++){let h=i[u];if(h[1]>h[0]){let d=h[0]-l;d>0&&a(o,l,n,d,n+r),l=h[1]}}let c=e+s-l,f=10;c>0&&a(o,l,n-f/2,c,n+r+f)}return o}function LE(i,t,e){let n=i[i.length-1];n&&n[0]==t?n[1]=e:i.push([t,e])}function pm(i,t,e,n,s,r,o){let a=[],l=i.length;for(let c=s==1?e:n;c>=e&&c<=n;c+=s)if(t[c]===null){let u=c,h=c;if(s==1)for(;++c<=n&&t[c]===null;)h=c;else for(;--c>=e&&t[c]===null;)h=c;let d=r(i[u]),g=h==u?d:r(i[h]),v=u-s;d=o<=0&&v>=0&&v<l?r(i[v]):d;let p=h+s;g=o>=0&&p>=0&&p<l?r(i[p]):g,g>=d&&a.push([d,g])}return a}function Lx(i){return i==0?Gx:i==1?Ln:t=>Br(t,i)}function fy(i){let t=i==0?ef:nf,e=i==0?(s,r,o,a,l,c)=>{s.arcTo(r,o,a,l,c)}:(s,r,o,a,l,c)=>{s.arcTo(o,r,l,a,c)},n=i==0?(s,r,o,a,l)=>{s.rect(r,o,a,l)}:(s,r,o,a,l)=>{s.rect(o,r,l,a)};return(s,r,o,a,l,c=0,f=0)=>{c==0&&f==0?n(s,r,o,a,l):(c=Ki(c,a/2,l/2),f=Ki(f,a/2,l/2),t(s,r+c,o),e(s,r+a,o,r+a,o+l,c),e(s,r+a,o+l,r,o+l,f),e(s,r,o+l,r,o,f),e(s,r,o,r+a,o,c),s.closePath())}}var ef=(i,t,e)=>{i.moveTo(t,e)},nf=(i,t,e)=>{i.moveTo(e,t)},fa=(i,t,e)=>{i.lineTo(t,e)},da=(i,t,e)=>{i.lineTo(e,t)},sf=fy(0),mm=fy(1),dy=(i,t,e,n,s,r)=>{i.arc(t,e,n,s,r)},py=(i,t,e,n,s,r)=>{i.arc(e,t,n,s,r)},my=(i,t,e,n,s,r,o)=>{i.bezierCurveTo(t,e,n,s,r,o)},gy=(i,t,e,n,s,r,o)=>{i.bezierCurveTo(e,t,s,n,o,r)};function _y(i){return(t,e,n,s,r)=>Hr(t,e,(o,a,l,c,f,u,h,d,g,v,m)=>{let{pxRound:p,points:_}=o,M,y;c.ori==0?(M=ef,y=dy):(M=nf,y=py);let w=He(_.width*Ce,3),T=(_.size-_.width)/2*Ce,x=He(T*2,3),b=new Path2D,D=new Path2D,{left:C,top:P,width:I,height:O}=t.bbox;sf(D,C-x,P-x,I+x*2,O+x*2);let L=z=>{if(l[z]!=null){let X=p(u(a[z],c,v,d)),H=p(h(l[z],f,m,g));M(b,X+T,H),y(b,X,H,T,0,qu*2)}};if(r)r.forEach(L);else for(let z=n;z<=s;z++)L(z);return{stroke:w>0?b:null,fill:b,clip:D,flags:ha|Qp}})}function xy(i){return(t,e,n,s,r,o)=>{n!=s&&(r!=n&&o!=n&&i(t,e,n),r!=s&&o!=s&&i(t,e,s),i(t,e,o))}}var DE=xy(fa),NE=xy(da);function yy(i){let t=be(i?.alignGaps,0);return(e,n,s,r)=>Hr(e,n,(o,a,l,c,f,u,h,d,g,v,m)=>{[s,r]=Ku(l,s,r);let p=o.pxRound,_=O=>p(u(O,c,v,d)),M=O=>p(h(O,f,m,g)),y,w;c.ori==0?(y=fa,w=DE):(y=da,w=NE);let T=c.dir*(c.ori==0?1:-1),x={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:ha},b=x.stroke,D=!1;if(r-s>=v*4){let O=ht=>e.posToVal(ht,c.key,!0),L=null,z=null,X,H,at,Z=_(a[T==1?s:r]),j=_(a[s]),nt=_(a[r]),ut=O(T==1?j+1:nt-1);for(let ht=T==1?s:r;ht>=s&&ht<=r;ht+=T){let Q=a[ht],gt=(T==1?Q<ut:Q>ut)?Z:_(Q),Et=l[ht];gt==Z?Et!=null?(H=Et,L==null?(y(b,gt,M(H)),X=L=z=H):H<L?L=H:H>z&&(z=H)):Et===null&&(D=!0):(L!=null&&w(b,Z,M(L),M(z),M(X),M(H)),Et!=null?(H=Et,y(b,gt,M(H)),L=z=X=H):(L=z=null,Et===null&&(D=!0)),Z=gt,ut=O(Z+T))}L!=null&&L!=z&&at!=Z&&w(b,Z,M(L),M(z),M(X),M(H))}else for(let O=T==1?s:r;O>=s&&O<=r;O+=T){let L=l[O];L===null?D=!0:L!=null&&y(b,_(a[O]),M(L))}let[P,I]=dm(e,n);if(o.fill!=null||P!=0){let O=x.fill=new Path2D(b),L=o.fillTo(e,n,o.min,o.max,P),z=M(L),X=_(a[s]),H=_(a[r]);T==-1&&([H,X]=[X,H]),y(O,H,z),y(O,X,z)}if(!o.spanGaps){let O=[];D&&O.push(...pm(a,l,s,r,T,_,t)),x.gaps=O=o.gaps(e,n,s,r,O),x.clip=tf(O,c.ori,d,g,v,m)}return I!=0&&(x.band=I==2?[zs(e,n,s,r,b,-1),zs(e,n,s,r,b,1)]:zs(e,n,s,r,b,I)),x})}function UE(i){let t=be(i.align,1),e=be(i.ascDesc,!1),n=be(i.alignGaps,0),s=be(i.extend,!1);return(r,o,a,l)=>Hr(r,o,(c,f,u,h,d,g,v,m,p,_,M)=>{[a,l]=Ku(u,a,l);let y=c.pxRound,{left:w,width:T}=r.bbox,x=j=>y(g(j,h,_,m)),b=j=>y(v(j,d,M,p)),D=h.ori==0?fa:da,C={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:ha},P=C.stroke,I=h.dir*(h.ori==0?1:-1),O=b(u[I==1?a:l]),L=x(f[I==1?a:l]),z=L,X=L;s&&t==-1&&(X=w,D(P,X,O)),D(P,L,O);for(let j=I==1?a:l;j>=a&&j<=l;j+=I){let nt=u[j];if(nt==null)continue;let ut=x(f[j]),ht=b(nt);t==1?D(P,ut,O):D(P,z,ht),D(P,ut,ht),O=ht,z=ut}let H=z;s&&t==1&&(H=w+T,D(P,H,O));let[at,Z]=dm(r,o);if(c.fill!=null||at!=0){let j=C.fill=new Path2D(P),nt=c.fillTo(r,o,c.min,c.max,at),ut=b(nt);D(j,H,ut),D(j,X,ut)}if(!c.spanGaps){let j=[];j.push(...pm(f,u,a,l,I,x,n));let nt=c.width*Ce/2,ut=e||t==1?nt:-nt,ht=e||t==-1?-nt:nt;j.forEach(Q=>{Q[0]+=ut,Q[1]+=ht}),C.gaps=j=c.gaps(r,o,a,l,j),C.clip=tf(j,h.ori,m,p,_,M)}return Z!=0&&(C.band=Z==2?[zs(r,o,a,l,P,-1),zs(r,o,a,l,P,1)]:zs(r,o,a,l,P,Z)),C})}function Dx(i,t,e,n,s,r,o=Ge){if(i.length>1){let a=null;for(let l=0,c=1/0;l<i.length;l++)if(t[l]!==void 0){if(a!=null){let f=Dn(i[l]-i[a]);f<c&&(c=f,o=Dn(e(i[l],n,s,r)-e(i[a],n,s,r)))}a=l}}return o}function FE(i){i=i||Dl;let t=be(i.size,[.6,Ge,1]),e=i.align||0,n=i.gap||0,s=i.radius;s=s==null?[0,0]:typeof s=="number"?[s,0]:s;let r=ye(s),o=1-t[0],a=be(t[1],Ge),l=be(t[2],1),c=be(i.disp,Dl),f=be(i.each,d=>{}),{fill:u,stroke:h}=c;return(d,g,v,m)=>Hr(d,g,(p,_,M,y,w,T,x,b,D,C,P)=>{let I=p.pxRound,O=e,L=n*Ce,z=a*Ce,X=l*Ce,H,at;y.ori==0?[H,at]=r(d,g):[at,H]=r(d,g);let Z=y.dir*(y.ori==0?1:-1),j=y.ori==0?sf:mm,nt=y.ori==0?f:(Rt,Zt,oe,bt,ze,Gt,qt)=>{f(Rt,Zt,oe,ze,bt,qt,Gt)},ut=be(d.bands,lm).find(Rt=>Rt.series[0]==g),ht=ut!=null?ut.dir:0,Q=p.fillTo(d,g,p.min,p.max,ht),dt=I(x(Q,w,P,D)),gt,Et,St,Ht=C,ne=I(p.width*Ce),Vt=!1,le=null,he=null,se=null,Qe=null;u!=null&&(ne==0||h!=null)&&(Vt=!0,le=u.values(d,g,v,m),he=new Map,new Set(le).forEach(Rt=>{Rt!=null&&he.set(Rt,new Path2D)}),ne>0&&(se=h.values(d,g,v,m),Qe=new Map,new Set(se).forEach(Rt=>{Rt!=null&&Qe.set(Rt,new Path2D)})));let{x0:We,size:gn}=c;if(We!=null&&gn!=null){O=1,_=We.values(d,g,v,m),We.unit==2&&(_=_.map(oe=>d.posToVal(b+oe*C,y.key,!0)));let Rt=gn.values(d,g,v,m);gn.unit==2?Et=Rt[0]*C:Et=T(Rt[0],y,C,b)-T(0,y,C,b),Ht=Dx(_,M,T,y,C,b,Ht),St=Ht-Et+L}else Ht=Dx(_,M,T,y,C,b,Ht),St=Ht*o+L,Et=Ht-St;St<1&&(St=0),ne>=Et/2&&(ne=0),St<5&&(I=Gx);let Ue=St>0,Nn=Ht-St-(Ue?ne:0);Et=I(Kp(Nn,X,z)),gt=(O==0?Et/2:O==Z?0:Et)-O*Z*((O==0?L/2:0)+(Ue?ne/2:0));let ve={stroke:null,fill:null,clip:null,band:null,gaps:null,flags:0},wn=Vt?null:new Path2D,rn=null;if(ut!=null)rn=d.data[ut.series[1]];else{let{y0:Rt,y1:Zt}=c;Rt!=null&&Zt!=null&&(M=Zt.values(d,g,v,m),rn=Rt.values(d,g,v,m))}let _n=H*Et,V=at*Et;for(let Rt=Z==1?v:m;Rt>=v&&Rt<=m;Rt+=Z){let Zt=M[Rt];if(Zt==null)continue;if(rn!=null){let q=rn[Rt]??0;if(Zt-q==0)continue;dt=x(q,w,P,D)}let oe=y.distr!=2||c!=null?_[Rt]:Rt,bt=T(oe,y,C,b),ze=x(be(Zt,Q),w,P,D),Gt=I(bt-gt),qt=I(li(ze,dt)),N=I(Ki(ze,dt)),A=qt-N;if(Zt!=null){let q=Zt<0?V:_n,ct=Zt<0?_n:V;Vt?(ne>0&&se[Rt]!=null&&j(Qe.get(se[Rt]),Gt,N+Ai(ne/2),Et,li(0,A-ne),q,ct),le[Rt]!=null&&j(he.get(le[Rt]),Gt,N+Ai(ne/2),Et,li(0,A-ne),q,ct)):j(wn,Gt,N+Ai(ne/2),Et,li(0,A-ne),q,ct),nt(d,g,Rt,Gt-ne/2,N,Et+ne,A)}}return ne>0?ve.stroke=Vt?Qe:wn:Vt||(ve._fill=p.width==0?p._fill:p._stroke??p._fill,ve.width=0),ve.fill=Vt?he:wn,ve})}function OE(i,t){let e=be(t?.alignGaps,0);return(n,s,r,o)=>Hr(n,s,(a,l,c,f,u,h,d,g,v,m,p)=>{[r,o]=Ku(c,r,o);let _=a.pxRound,M=H=>_(h(H,f,m,g)),y=H=>_(d(H,u,p,v)),w,T,x;f.ori==0?(w=ef,x=fa,T=my):(w=nf,x=da,T=gy);let b=f.dir*(f.ori==0?1:-1),D=M(l[b==1?r:o]),C=D,P=[],I=[];for(let H=b==1?r:o;H>=r&&H<=o;H+=b)if(c[H]!=null){let Z=l[H],j=M(Z);P.push(C=j),I.push(y(c[H]))}let O={stroke:i(P,I,w,x,T,_),fill:null,clip:null,band:null,gaps:null,flags:ha},L=O.stroke,[z,X]=dm(n,s);if(a.fill!=null||z!=0){let H=O.fill=new Path2D(L),at=a.fillTo(n,s,a.min,a.max,z),Z=y(at);x(H,C,Z),x(H,D,Z)}if(!a.spanGaps){let H=[];H.push(...pm(l,c,r,o,b,M,e)),O.gaps=H=a.gaps(n,s,r,o,H),O.clip=tf(H,f.ori,g,v,m,p)}return X!=0&&(O.band=X==2?[zs(n,s,r,o,L,-1),zs(n,s,r,o,L,1)]:zs(n,s,r,o,L,X)),O})}function BE(i){return OE(zE,i)}function zE(i,t,e,n,s,r){let o=i.length;if(o<2)return null;let a=new Path2D;if(e(a,i[0],t[0]),o==2)n(a,i[1],t[1]);else{let l=Array(o),c=Array(o-1),f=Array(o-1),u=Array(o-1);for(let h=0;h<o-1;h++)f[h]=t[h+1]-t[h],u[h]=i[h+1]-i[h],c[h]=f[h]/u[h];l[0]=c[0];for(let h=1;h<o-1;h++)c[h]===0||c[h-1]===0||c[h-1]>0!=c[h]>0?l[h]=0:(l[h]=3*(u[h-1]+u[h])/((2*u[h]+u[h-1])/c[h-1]+(u[h]+2*u[h-1])/c[h]),isFinite(l[h])||(l[h]=0));l[o-1]=c[o-2];for(let h=0;h<o-1;h++)s(a,i[h]+u[h]/3,t[h]+l[h]*u[h]/3,i[h+1]-u[h]/3,t[h+1]-l[h+1]*u[h]/3,i[h+1],t[h+1])}return a}var tm=new Set;function Nx(){for(let i of tm)i.syncRect(!0)}ua&&(Vr(yA,oa,Nx),Vr(vA,oa,Nx,!0),Vr(Yu,oa,()=>{Gn.pxRatio=Ce}));var kE=yy(),VE=_y();function Ux(i,t,e,n){return(n?[i[0],i[1]].concat(i.slice(2)):[i[0]].concat(i.slice(1))).map((r,o)=>em(r,o,t,e))}function GE(i,t){return i.map((e,n)=>n==0?{}:bn({},t,e))}function em(i,t,e,n){return bn({},t==0?e:n,i)}function vy(i,t,e){return t==null?la:[t,e]}var HE=vy;function WE(i,t,e){return t==null?la:Zu(t,e,om,!0)}function Sy(i,t,e,n){return t==null?la:Ju(t,e,i.scales[n].log,!1)}var XE=Sy;function My(i,t,e,n){return t==null?la:rm(t,e,i.scales[n].log,!1)}var qE=My;function YE(i,t,e,n,s){let r=li(dx(i),dx(t)),o=t-i,a=$i(s/n*o,e);do{let l=e[a],c=n*l/o;if(c>=s&&r+(l<5?mr.get(l):0)<=17)return[l,c]}while(++a<e.length);return[0,0]}function Fx(i){let t,e;return i=i.replace(/(\d+)px/,(n,s)=>(t=Ln((e=+s)*Ce))+"px"),[i,t,e]}function ZE(i){i.show&&[i.font,i.labelFont].forEach(t=>{let e=He(t[2]*Ce,1);t[0]=t[0].replace(/[0-9.]+px/,e+"px"),t[1]=e})}function Gn(i,t,e){let n={mode:be(i.mode,1)},s=n.mode;function r(S,E,F,B){let W=E.valToPct(S);return B+F*(E.dir==-1?1-W:W)}function o(S,E,F,B){let W=E.valToPct(S);return B+F*(E.dir==-1?W:1-W)}function a(S,E,F,B){return E.ori==0?r(S,E,F,B):o(S,E,F,B)}n.valToPosH=r,n.valToPosV=o;let l=!1;n.status=0;let c=n.root=Di(eA);if(i.id!=null&&(c.id=i.id),Ti(c,i.class),i.title){let S=Di(sA,c);S.textContent=i.title}let f=Zi("canvas"),u=n.ctx=f.getContext("2d"),h=Di(rA,c);Vr("click",h,S=>{S.target===g&&(Ye!=Jr||tn!=jr)&&Hn.click(n,S)},!0);let d=n.under=Di(oA,h);h.appendChild(f);let g=n.over=Di(aA,h);i=ca(i);let v=+be(i.pxAlign,1),m=Lx(v);(i.plugins||[]).forEach(S=>{S.opts&&(i=S.opts(n,i)||i)});let p=i.ms||.001,_=n.series=s==1?Ux(i.series||[],Tx,Px,!1):GE(i.series||[null],Rx),M=n.axes=Ux(i.axes||[],wx,Ex,!0),y=n.scales={},w=n.bands=i.bands||[];w.forEach(S=>{S.fill=ye(S.fill||null),S.dir=be(S.dir,-1)});let T=s==2?_[1].facets[0].scale:_[0].scale,x={axes:Ss,series:pe},b=(i.drawOrder||["axes","series"]).map(S=>x[S]);function D(S){let E=S.distr==3?F=>Bs(F>0?F:S.clamp(n,F,S.min,S.max,S.key)):S.distr==4?F=>Gp(F,S.asinh):S.distr==100?F=>S.fwd(F):F=>F;return F=>{let B=E(F),{_min:W,_max:K}=S,ot=K-W;return(B-W)/ot}}function C(S){let E=y[S];if(E==null){let F=(i.scales||Dl)[S]||Dl;if(F.from!=null){C(F.from);let B=bn({},y[F.from],F,{key:S});B.valToPct=D(B),y[S]=B}else{E=y[S]=bn({},S==T?hy:PE,F),E.key=S;let B=E.time,W=E.range,K=pr(W);if((S!=T||s==2&&!B)&&(K&&(W[0]==null||W[1]==null)&&(W={min:W[0]==null?hx:{mode:1,hard:W[0],soft:W[0]},max:W[1]==null?hx:{mode:1,hard:W[1],soft:W[1]}},K=!1),!K&&Qu(W))){let ot=W;W=(ft,vt,Dt)=>vt==null?la:Zu(vt,Dt,ot)}E.range=ye(W||(B?HE:S==T?E.distr==3?XE:E.distr==4?qE:vy:E.distr==3?Sy:E.distr==4?My:WE)),E.auto=ye(K?!1:E.auto),E.clamp=ye(E.clamp||RE),E._min=E._max=null,E.valToPct=D(E)}}}C("x"),C("y"),s==1&&_.forEach(S=>{C(S.scale)}),M.forEach(S=>{C(S.scale)});for(let S in i.scales)C(S);let P=y[T],I=P.distr,O,L;P.ori==0?(Ti(c,nA),O=r,L=o):(Ti(c,iA),O=o,L=r);let z={};for(let S in y){let E=y[S];(E.min!=null||E.max!=null)&&(z[S]={min:E.min,max:E.max},E.min=E.max=null)}let X=i.tzDate||(S=>new Date(Ln(S/p))),H=i.fmtDate||cm,at=p==1?nE(X):rE(X),Z=Sx(X,vx(p==1?eE:sE,H)),j=bx(X,Mx(aE,H)),nt=[],ut=n.legend=bn({},hE,i.legend),ht=n.cursor=bn({},gE,{drag:{y:s==2}},i.cursor),Q=ut.show,dt=ht.show,gt=ut.markers;ut.idxs=nt,gt.width=ye(gt.width),gt.dash=ye(gt.dash),gt.stroke=ye(gt.stroke),gt.fill=ye(gt.fill);let Et,St,Ht,ne=[],Vt=[],le,he=!1,se={};if(ut.live){let S=_[1]?_[1].values:null;he=S!=null,le=he?S(n,1,0):{_:0};for(let E in le)se[E]=im}if(Q)if(Et=Zi("table",dA,c),Ht=Zi("tbody",null,Et),ut.mount(n,Et),he){St=Zi("thead",null,Et,Ht);let S=Zi("tr",null,St);Zi("th",null,S);for(var Qe in le)Zi("th",J_,S).textContent=Qe}else Ti(Et,mA),ut.live&&Ti(Et,pA);let We={show:!0},gn={show:!1};function Ue(S,E){if(E==0&&(he||!ut.live||s==2))return la;let F=[],B=Zi("tr",gA,Ht,Ht.childNodes[E]);Ti(B,S.class),S.show||Ti(B,kr);let W=Zi("th",null,B);if(gt.show){let ft=Di(_A,W);if(E>0){let vt=gt.width(n,E);vt&&(ft.style.border=vt+"px "+gt.dash(n,E)+" "+gt.stroke(n,E)),ft.style.background=gt.fill(n,E)}}let K=Di(J_,W);S.label instanceof HTMLElement?K.appendChild(S.label):K.textContent=S.label,E>0&&(gt.show||(K.style.color=S.width>0?gt.stroke(n,E):gt.fill(n,E)),ve("click",W,ft=>{if(ht._lock)return;Jt(ft);let vt=_.indexOf(S);if((ft.ctrlKey||ft.metaKey)!=ut.isolate){let Dt=_.some((Nt,Ft)=>Ft>0&&Ft!=vt&&Nt.show);_.forEach((Nt,Ft)=>{Ft>0&&ts(Ft,Dt?Ft==vt?We:gn:We,!0,Sn.setSeries)})}else ts(vt,{show:!S.show},!0,Sn.setSeries)},!1),jt&&ve(ex,W,ft=>{ht._lock||(Jt(ft),ts(_.indexOf(S),to,!0,Sn.setSeries))},!1));for(var ot in le){let ft=Zi("td",xA,B);ft.textContent="--",F.push(ft)}return[B,F]}let Nn=new Map;function ve(S,E,F,B=!0){let W=Nn.get(E)||{},K=ht.bind[S](n,E,F,B);K&&(Vr(S,E,W[S]=K),Nn.set(E,W))}function wn(S,E,F){let B=Nn.get(E)||{};for(let W in B)(S==null||W==S)&&($p(W,E,B[W]),delete B[W]);S==null&&Nn.delete(E)}let rn=0,_n=0,V=0,Rt=0,Zt=0,oe=0,bt=Zt,ze=oe,Gt=V,qt=Rt,N=0,A=0,q=0,ct=0;n.bbox={};let rt=!1,xt=!1,yt=!1,tt=!1,it=!1,pt=!1;function k(S,E,F){(F||S!=n.width||E!=n.height)&&st(S,E),ue(!1),yt=!0,xt=!0,qn()}function st(S,E){n.width=rn=V=S,n.height=_n=Rt=E,Zt=oe=0,Mt(),Wt();let F=n.bbox;N=F.left=Br(Zt*Ce,.5),A=F.top=Br(oe*Ce,.5),q=F.width=Br(V*Ce,.5),ct=F.height=Br(Rt*Ce,.5)}let et=3;function wt(){let S=!1,E=0;for(;!S;){E++;let F=Zr(E),B=Qi(E);S=E==et||F&&B,S||(st(n.width,n.height),xt=!0)}}function _t({width:S,height:E}){k(S,E)}n.setSize=_t;function Mt(){let S=!1,E=!1,F=!1,B=!1;M.forEach((W,K)=>{if(W.show&&W._show){let{side:ot,_size:ft}=W,vt=ot%2,Dt=W.label!=null?W.labelSize:0,Nt=ft+Dt;Nt>0&&(vt?(V-=Nt,ot==3?(Zt+=Nt,B=!0):F=!0):(Rt-=Nt,ot==0?(oe+=Nt,S=!0):E=!0))}}),Ji[0]=S,Ji[1]=F,Ji[2]=E,Ji[3]=B,V-=Ui[1]+Ui[3],Zt+=Ui[3],Rt-=Ui[2]+Ui[0],oe+=Ui[0]}function Wt(){let S=Zt+V,E=oe+Rt,F=Zt,B=oe;function W(K,ot){switch(K){case 1:return S+=ot,S-ot;case 2:return E+=ot,E-ot;case 3:return F-=ot,F+ot;case 0:return B-=ot,B+ot}}M.forEach((K,ot)=>{if(K.show&&K._show){let ft=K.side;K._pos=W(ft,K._size),K.label!=null&&(K._lpos=W(ft,K.labelSize))}})}if(ht.dataIdx==null){let S=ht.hover,E=S.skip=new Set(S.skip??[]);E.add(void 0);let F=S.prox=ye(S.prox),B=S.bias??(S.bias=0);ht.dataIdx=(W,K,ot,ft)=>{if(K==0)return ot;let vt=ot,Dt=F(W,K,ot,ft)??Ge,Nt=Dt>=0&&Dt<Ge,Ft=P.ori==0?V:Rt,re=ht.left,we=t[0],Me=t[K];if(E.has(Me[ot])){vt=null;let me=null,Kt=null,Xt;if(B==0||B==-1)for(Xt=ot;me==null&&Xt-- >0;)E.has(Me[Xt])||(me=Xt);if(B==0||B==1)for(Xt=ot;Kt==null&&Xt++<Me.length;)E.has(Me[Xt])||(Kt=Xt);if(me!=null||Kt!=null)if(Nt){let $e=me==null?-1/0:O(we[me],P,Ft,0),ln=Kt==null?1/0:O(we[Kt],P,Ft,0),Bn=re-$e,Fe=ln-re;Bn<=Fe?Bn<=Dt&&(vt=me):Fe<=Dt&&(vt=Kt)}else vt=Kt==null?me:me==null?Kt:ot-me<=Kt-ot?me:Kt}else Nt&&Dn(re-O(we[ot],P,Ft,0))>Dt&&(vt=null);return vt}}let Jt=S=>{ht.event=S};ht.idxs=nt,ht._lock=!1;let lt=ht.points;lt.show=ye(lt.show),lt.size=ye(lt.size),lt.stroke=ye(lt.stroke),lt.width=ye(lt.width),lt.fill=ye(lt.fill);let Ot=n.focus=bn({},i.focus||{alpha:.3},ht.focus),jt=Ot.prox>=0,Ct=jt&&lt.one,ce=[],qe=[],jn=[];function ma(S,E){let F=lt.show(n,E);if(F instanceof HTMLElement)return Ti(F,fA),Ti(F,S.class),_s(F,-10,-10,V,Rt),g.insertBefore(F,ce[E]),F}function Xr(S,E){if(s==1||E>0){let F=s==1&&y[S.scale].time,B=S.value;S.value=F?gx(B)?bx(X,Mx(B,H)):B||j:B||AE,S.label=S.label||(F?xE:_E)}if(Ct||E>0){S.width=S.width==null?1:S.width,S.paths=S.paths||kE||PA,S.fillTo=ye(S.fillTo||IE),S.pxAlign=+be(S.pxAlign,v),S.pxRound=Lx(S.pxAlign),S.stroke=ye(S.stroke||null),S.fill=ye(S.fill||null),S._stroke=S._fill=S._paths=S._focus=null;let F=EE(li(1,S.width),1),B=S.points=bn({},{size:F,width:li(1,F*.2),stroke:S.stroke,space:F*2,paths:VE,_stroke:null,_fill:null},S.points);B.show=ye(B.show),B.filter=ye(B.filter),B.fill=ye(B.fill),B.stroke=ye(B.stroke),B.paths=ye(B.paths),B.pxAlign=S.pxAlign}if(Q){let F=Ue(S,E);ne.splice(E,0,F[0]),Vt.splice(E,0,F[1]),ut.values.push(null)}if(dt){nt.splice(E,0,null);let F=null;Ct?E==0&&(F=ma(S,E)):E>0&&(F=ma(S,E)),ce.splice(E,0,F),qe.splice(E,0,0),jn.splice(E,0,0)}On("addSeries",E)}function xf(S,E){E=E??_.length,S=s==1?em(S,E,Tx,Px):em(S,E,{},Rx),_.splice(E,0,S),Xr(_[E],E)}n.addSeries=xf;function Bl(S){if(_.splice(S,1),Q){ut.values.splice(S,1),Vt.splice(S,1);let E=ne.splice(S,1)[0];wn(null,E.firstChild),E.remove()}dt&&(nt.splice(S,1),ce.splice(S,1)[0].remove(),qe.splice(S,1),jn.splice(S,1)),On("delSeries",S)}n.delSeries=Bl;let Ji=[!1,!1,!1,!1];function xs(S,E){if(S._show=S.show,S.show){let F=S.side%2,B=y[S.scale];B==null&&(S.scale=F?_[1].scale:T,B=y[S.scale]);let W=B.time;S.size=ye(S.size),S.space=ye(S.space),S.rotate=ye(S.rotate),pr(S.incrs)&&S.incrs.forEach(ot=>{!mr.has(ot)&&mr.set(ot,Xx(ot))}),S.incrs=ye(S.incrs||(B.distr==2?jA:W?p==1?tE:iE:zr)),S.splits=ye(S.splits||(W&&B.distr==1?at:B.distr==3?Jp:B.distr==4?SE:vE)),S.stroke=ye(S.stroke),S.grid.stroke=ye(S.grid.stroke),S.ticks.stroke=ye(S.ticks.stroke),S.border.stroke=ye(S.border.stroke);let K=S.values;S.values=pr(K)&&!pr(K[0])?ye(K):W?pr(K)?Sx(X,vx(K,H)):gx(K)?oE(X,K):K||Z:K||yE,S.filter=ye(S.filter||(B.distr>=3&&B.log==10?wE:B.distr==3&&B.log==2?TE:Hx)),S.font=Fx(S.font),S.labelFont=Fx(S.labelFont),S._size=S.size(n,null,E,0),S._space=S._rotate=S._incrs=S._found=S._splits=S._values=null,S._size>0&&(Ji[E]=!0,S._el=Di(lA,h))}}function ys(S,E,F,B){let[W,K,ot,ft]=F,vt=E%2,Dt=0;return vt==0&&(ft||K)&&(Dt=E==0&&!W||E==2&&!ot?Ln(wx.size/3):0),vt==1&&(W||ot)&&(Dt=E==1&&!K||E==3&&!ft?Ln(Ex.size/2):0),Dt}let ga=n.padding=(i.padding||[ys,ys,ys,ys]).map(S=>ye(be(S,ys))),Ui=n._padding=ga.map((S,E)=>S(n,E,Ji,0)),on,un=null,fn=null,ji=s==1?_[0].idxs:null,di=null,ks=!1;function _a(S,E){if(t=S??[],n.data=n._data=t,s==2){on=0;for(let F=1;F<_.length;F++)on+=t[F][0].length}else{t.length==0&&(n.data=n._data=t=[[]]),di=t[0],on=di.length;let F=t;if(I==2){F=t.slice();let B=F[0]=Array(on);for(let W=0;W<on;W++)B[W]=W}n._data=t=F}if(ue(!0),On("setData"),I==2&&(yt=!0),E!==!1){let F=P;F.auto(n,ks)?xa():Hs(T,F.min,F.max),tt=tt||ht.left>=0,pt=!0,qn()}}n.setData=_a;function xa(){ks=!0;let S,E;s==1&&(on>0?(un=ji[0]=0,fn=ji[1]=on-1,S=t[0][un],E=t[0][fn],I==2?(S=un,E=fn):S==E&&(I==3?[S,E]=Ju(S,S,P.log,!1):I==4?[S,E]=rm(S,S,P.log,!1):P.time?E=S+Ln(86400/p):[S,E]=Zu(S,E,om,!0))):(un=ji[0]=S=null,fn=ji[1]=E=null)),Hs(T,S,E)}let qr,Vs,Yr,R,G,J,Y,$,Tt,Pt;function At(S,E,F,B,W,K){S??(S=Q_),F??(F=lm),B??(B="butt"),W??(W=Q_),K??(K="round"),S!=qr&&(u.strokeStyle=qr=S),W!=Vs&&(u.fillStyle=Vs=W),E!=Yr&&(u.lineWidth=Yr=E),K!=G&&(u.lineJoin=G=K),B!=J&&(u.lineCap=J=B),F!=R&&u.setLineDash(R=F)}function It(S,E,F,B){E!=Vs&&(u.fillStyle=Vs=E),S!=Y&&(u.font=Y=S),F!=$&&(u.textAlign=$=F),B!=Tt&&(u.textBaseline=Tt=B)}function zt(S,E,F,B,W=0){if(B.length>0&&S.auto(n,ks)&&(E==null||E.min==null)){let K=be(un,0),ot=be(fn,B.length-1),ft=F.min==null?wA(B,K,ot,W,S.distr==3):[F.min,F.max];S.min=Ki(S.min,F.min=ft[0]),S.max=li(S.max,F.max=ft[1])}}let ee={min:null,max:null};function de(){for(let B in y){let W=y[B];z[B]==null&&(W.min==null||z[T]!=null&&W.auto(n,ks))&&(z[B]=ee)}for(let B in y){let W=y[B];z[B]==null&&W.from!=null&&z[W.from]!=null&&(z[B]=ee)}z[T]!=null&&ue(!0);let S={};for(let B in z){let W=z[B];if(W!=null){let K=S[B]=ca(y[B],DA);if(W.min!=null)bn(K,W);else if(B!=T||s==2)if(on==0&&K.from==null){let ot=K.range(n,null,null,B);K.min=ot[0],K.max=ot[1]}else K.min=Ge,K.max=-Ge}}if(on>0){_.forEach((B,W)=>{if(s==1){let K=B.scale,ot=z[K];if(ot==null)return;let ft=S[K];if(W==0){let vt=ft.range(n,ft.min,ft.max,K);ft.min=vt[0],ft.max=vt[1],un=$i(ft.min,t[0]),fn=$i(ft.max,t[0]),fn-un>1&&(t[0][un]<ft.min&&un++,t[0][fn]>ft.max&&fn--),B.min=di[un],B.max=di[fn]}else B.show&&B.auto&&zt(ft,ot,B,t[W],B.sorted);B.idxs[0]=un,B.idxs[1]=fn}else if(W>0&&B.show&&B.auto){let[K,ot]=B.facets,ft=K.scale,vt=ot.scale,[Dt,Nt]=t[W],Ft=S[ft],re=S[vt];Ft!=null&&zt(Ft,z[ft],K,Dt,K.sorted),re!=null&&zt(re,z[vt],ot,Nt,ot.sorted),B.min=ot.min,B.max=ot.max}});for(let B in S){let W=S[B],K=z[B];if(W.from==null&&(K==null||K.min==null)){let ot=W.range(n,W.min==Ge?null:W.min,W.max==-Ge?null:W.max,B);W.min=ot[0],W.max=ot[1]}}}for(let B in S){let W=S[B];if(W.from!=null){let K=S[W.from];if(K.min==null)W.min=W.max=null;else{let ot=W.range(n,K.min,K.max,B);W.min=ot[0],W.max=ot[1]}}}let E={},F=!1;for(let B in S){let W=S[B],K=y[B];if(K.min!=W.min||K.max!=W.max){K.min=W.min,K.max=W.max;let ot=K.distr;K._min=ot==3?Bs(K.min):ot==4?Gp(K.min,K.asinh):ot==100?K.fwd(K.min):K.min,K._max=ot==3?Bs(K.max):ot==4?Gp(K.max,K.asinh):ot==100?K.fwd(K.max):K.max,E[B]=F=!0}}if(F){_.forEach((B,W)=>{s==2?W>0&&E.y&&(B._paths=null):E[B.scale]&&(B._paths=null)});for(let B in E)yt=!0,On("setScale",B);dt&&ht.left>=0&&(tt=pt=!0)}for(let B in z)z[B]=null}function Bt(S){let E=Kp(un-1,0,on-1),F=Kp(fn+1,0,on-1);for(;S[E]==null&&E>0;)E--;for(;S[F]==null&&F<on-1;)F++;return[E,F]}function pe(){if(on>0){let S=_.some(E=>E._focus)&&Pt!=Ot.alpha;S&&(u.globalAlpha=Pt=Ot.alpha),_.forEach((E,F)=>{if(F>0&&E.show&&(sn(F,!1),sn(F,!0),E._paths==null)){let B=Pt;Pt!=E.alpha&&(u.globalAlpha=Pt=E.alpha);let W=s==2?[0,t[F][0].length-1]:Bt(t[F]);E._paths=E.paths(n,F,W[0],W[1]),Pt!=B&&(u.globalAlpha=Pt=B)}}),_.forEach((E,F)=>{if(F>0&&E.show){let B=Pt;Pt!=E.alpha&&(u.globalAlpha=Pt=E.alpha),E._paths!=null&&Le(F,!1);{let W=E._paths!=null?E._paths.gaps:null,K=E.points.show(n,F,un,fn,W),ot=E.points.filter(n,F,K,W);(K||ot)&&(E.points._paths=E.points.paths(n,F,un,fn,ot),Le(F,!0))}Pt!=B&&(u.globalAlpha=Pt=B),On("drawSeries",F)}}),S&&(u.globalAlpha=Pt=1)}}function sn(S,E){let F=E?_[S].points:_[S];F._stroke=F.stroke(n,S),F._fill=F.fill(n,S)}function Le(S,E){let F=E?_[S].points:_[S],{stroke:B,fill:W,clip:K,flags:ot,_stroke:ft=F._stroke,_fill:vt=F._fill,_width:Dt=F.width}=F._paths;Dt=He(Dt*Ce,3);let Nt=null,Ft=Dt%2/2;E&&vt==null&&(vt=Dt>0?"#fff":ft);let re=F.pxAlign==1&&Ft>0;if(re&&u.translate(Ft,Ft),!E){let we=N-Dt/2,Me=A-Dt/2,me=q+Dt,Kt=ct+Dt;Nt=new Path2D,Nt.rect(we,Me,me,Kt)}E?Ut(ft,Dt,F.dash,F.cap,vt,B,W,ot,K):De(S,ft,Dt,F.dash,F.cap,vt,B,W,ot,Nt,K),re&&u.translate(-Ft,-Ft)}function De(S,E,F,B,W,K,ot,ft,vt,Dt,Nt){let Ft=!1;vt!=0&&w.forEach((re,we)=>{if(re.series[0]==S){let Me=_[re.series[1]],me=t[re.series[1]],Kt=(Me._paths||Dl).band;pr(Kt)&&(Kt=re.dir==1?Kt[0]:Kt[1]);let Xt,$e=null;Me.show&&Kt&&AA(me,un,fn)?($e=re.fill(n,we)||K,Xt=Me._paths.clip):Kt=null,Ut(E,F,B,W,$e,ot,ft,vt,Dt,Nt,Xt,Kt),Ft=!0}}),Ft||Ut(E,F,B,W,K,ot,ft,vt,Dt,Nt)}let Tn=ha|Qp;function Ut(S,E,F,B,W,K,ot,ft,vt,Dt,Nt,Ft){At(S,E,F,B,W),(vt||Dt||Ft)&&(u.save(),vt&&u.clip(vt),Dt&&u.clip(Dt)),Ft?(ft&Tn)==Tn?(u.clip(Ft),Nt&&u.clip(Nt),_e(W,ot),xn(S,K,E)):ft&Qp?(_e(W,ot),u.clip(Ft),xn(S,K,E)):ft&ha&&(u.save(),u.clip(Ft),Nt&&u.clip(Nt),_e(W,ot),u.restore(),xn(S,K,E)):(_e(W,ot),xn(S,K,E)),(vt||Dt||Ft)&&u.restore()}function xn(S,E,F){F>0&&(E instanceof Map?E.forEach((B,W)=>{u.strokeStyle=qr=W,u.stroke(B)}):E!=null&&S&&u.stroke(E))}function _e(S,E){E instanceof Map?E.forEach((F,B)=>{u.fillStyle=Vs=B,u.fill(F)}):E!=null&&S&&u.fill(E)}function vs(S,E,F,B){let W=M[S],K;if(B<=0)K=[0,0];else{let ot=W._space=W.space(n,S,E,F,B),ft=W._incrs=W.incrs(n,S,E,F,B,ot);K=YE(E,F,ft,B,ot)}return W._found=K}function yn(S,E,F,B,W,K,ot,ft,vt,Dt){let Nt=ot%2/2;v==1&&u.translate(Nt,Nt),At(ft,ot,vt,Dt,ft),u.beginPath();let Ft,re,we,Me,me=W+(B==0||B==3?-K:K);F==0?(re=W,Me=me):(Ft=W,we=me);for(let Kt=0;Kt<S.length;Kt++)E[Kt]!=null&&(F==0?Ft=we=S[Kt]:re=Me=S[Kt],u.moveTo(Ft,re),u.lineTo(we,Me));u.stroke(),v==1&&u.translate(-Nt,-Nt)}function Zr(S){let E=!0;return M.forEach((F,B)=>{if(!F.show)return;let W=y[F.scale];if(W.min==null){F._show&&(E=!1,F._show=!1,ue(!1));return}else F._show||(E=!1,F._show=!0,ue(!1));let K=F.side,ot=K%2,{min:ft,max:vt}=W,[Dt,Nt]=vs(B,ft,vt,ot==0?V:Rt);if(Nt==0)return;let Ft=W.distr==2,re=F._splits=F.splits(n,B,ft,vt,Dt,Nt,Ft),we=W.distr==2?re.map(Xt=>di[Xt]):re,Me=W.distr==2?di[re[1]]-di[re[0]]:Dt,me=F._values=F.values(n,F.filter(n,we,B,Nt,Me),B,Nt,Me);F._rotate=K==2?F.rotate(n,me,B,Nt):0;let Kt=F._size;F._size=Ni(F.size(n,me,B,S)),Kt!=null&&F._size!=Kt&&(E=!1)}),E}function Qi(S){let E=!0;return ga.forEach((F,B)=>{let W=F(n,B,Ji,S);W!=Ui[B]&&(E=!1),Ui[B]=W}),E}function Ss(){for(let S=0;S<M.length;S++){let E=M[S];if(!E.show||!E._show)continue;let F=E.side,B=F%2,W,K,ot=E.stroke(n,S),ft=F==0||F==3?-1:1,[vt,Dt]=E._found;if(E.label!=null){let ei=E.labelGap*ft,gi=Ln((E._lpos+ei)*Ce);It(E.labelFont[0],ot,"center",F==2?"top":j_),u.save(),B==1?(W=K=0,u.translate(gi,Ln(A+ct/2)),u.rotate((F==3?-qu:qu)/2)):(W=Ln(N+q/2),K=gi);let xr=Vx(E.label)?E.label(n,S,vt,Dt):E.label;u.fillText(xr,W,K),u.restore()}if(Dt==0)continue;let Nt=y[E.scale],Ft=B==0?q:ct,re=B==0?N:A,we=E._splits,Me=Nt.distr==2?we.map(ei=>di[ei]):we,me=Nt.distr==2?di[we[1]]-di[we[0]]:vt,Kt=E.ticks,Xt=E.border,$e=Kt.show?Kt.size:0,ln=Ln($e*Ce),Bn=Ln((E.alignTo==2?E._size-$e-E.gap:E.gap)*Ce),Fe=E._rotate*-qu/180,cn=m(E._pos*Ce),pi=(ln+Bn)*ft,ti=cn+pi;K=B==0?ti:0,W=B==1?ti:0;let Ci=E.font[0],Fi=E.align==1?sa:E.align==2?zp:Fe>0?sa:Fe<0?zp:B==0?"center":F==3?zp:sa,ns=Fe||B==1?"middle":F==2?"top":j_;It(Ci,ot,Fi,ns);let mi=E.font[1]*E.lineGap,Ri=we.map(ei=>m(a(ei,Nt,Ft,re))),Oi=E._values;for(let ei=0;ei<Oi.length;ei++){let gi=Oi[ei];if(gi!=null){B==0?W=Ri[ei]:K=Ri[ei],gi=""+gi;let xr=gi.indexOf(`
`)==-1?[gi]:gi.split(/\n/gm);for(let ni=0;ni<xr.length;ni++){let km=xr[ni];Fe?(u.save(),u.translate(W,K+ni*mi),u.rotate(Fe),u.fillText(km,0,0),u.restore()):u.fillText(km,W,K+ni*mi)}}}Kt.show&&yn(Ri,Kt.filter(n,Me,S,Dt,me),B,F,cn,ln,He(Kt.width*Ce,3),Kt.stroke(n,S),Kt.dash,Kt.cap);let is=E.grid;is.show&&yn(Ri,is.filter(n,Me,S,Dt,me),B,B==0?2:1,B==0?A:N,B==0?ct:q,He(is.width*Ce,3),is.stroke(n,S),is.dash,is.cap),Xt.show&&yn([cn],[1],B==0?1:0,B==0?1:2,B==1?A:N,B==1?ct:q,He(Xt.width*Ce,3),Xt.stroke(n,S),Xt.dash,Xt.cap)}On("drawAxes")}function ue(S){_.forEach((E,F)=>{F>0&&(E._paths=null,S&&(s==1?(E.min=null,E.max=null):E.facets.forEach(B=>{B.min=null,B.max=null})))})}let an=!1,Qn=!1,Ne=[];function vn(){Qn=!1;for(let S=0;S<Ne.length;S++)On(...Ne[S]);Ne.length=0}function qn(){an||(kA(Mm),an=!0)}function zl(S,E=!1){an=!0,Qn=E,S(n),Mm(),E&&Ne.length>0&&queueMicrotask(vn)}n.batch=zl;function Mm(){if(rt&&(de(),rt=!1),yt&&(wt(),yt=!1),xt){if(je(d,sa,Zt),je(d,"top",oe),je(d,Rl,V),je(d,Pl,Rt),je(g,sa,Zt),je(g,"top",oe),je(g,Rl,V),je(g,Pl,Rt),je(h,Rl,rn),je(h,Pl,_n),f.width=Ln(rn*Ce),f.height=Ln(_n*Ce),M.forEach(({_el:S,_show:E,_size:F,_pos:B,side:W})=>{if(S!=null)if(E){let K=W===3||W===0?F:0,ot=W%2==1;je(S,ot?"left":"top",B-K),je(S,ot?"width":"height",F),je(S,ot?"top":"left",ot?oe:Zt),je(S,ot?"height":"width",ot?Rt:V),Zp(S,kr)}else Ti(S,kr)}),qr=Vs=Yr=G=J=Y=$=Tt=R=null,Pt=1,Sa(!0),Zt!=bt||oe!=ze||V!=Gt||Rt!=qt){ue(!1);let S=V/Gt,E=Rt/qt;if(dt&&!tt&&ht.left>=0){ht.left*=S,ht.top*=E,$r&&_s($r,Ln(ht.left),0,V,Rt),Kr&&_s(Kr,0,Ln(ht.top),V,Rt);for(let F=0;F<ce.length;F++){let B=ce[F];B!=null&&(qe[F]*=S,jn[F]*=E,_s(B,Ni(qe[F]),Ni(jn[F]),V,Rt))}}if(Ze.show&&!it&&Ze.left>=0&&Ze.width>0){Ze.left*=S,Ze.width*=S,Ze.top*=E,Ze.height*=E;for(let F in wf)je(Qr,F,Ze[F])}bt=Zt,ze=oe,Gt=V,qt=Rt}On("setSize"),xt=!1}rn>0&&_n>0&&(u.clearRect(0,0,f.width,f.height),On("drawClear"),b.forEach(S=>S()),On("draw")),Ze.show&&it&&(kl(Ze),it=!1),dt&&tt&&(_r(null,!0,!1),tt=!1),ut.show&&ut.live&&pt&&(Mf(),pt=!1),l||(l=!0,n.status=1,On("ready")),ks=!1,an=!1}n.redraw=(S,E)=>{yt=E||!1,S!==!1?Hs(T,P.min,P.max):qn()};function yf(S,E){let F=y[S];if(F.from==null){if(on==0){let B=F.range(n,E.min,E.max,S);E.min=B[0],E.max=B[1]}if(E.min>E.max){let B=E.min;E.min=E.max,E.max=B}if(on>1&&E.min!=null&&E.max!=null&&E.max-E.min<1e-16)return;S==T&&F.distr==2&&on>0&&(E.min=$i(E.min,t[0]),E.max=$i(E.max,t[0]),E.min==E.max&&E.max++),z[S]=E,rt=!0,qn()}}n.setScale=yf;let vf,Sf,$r,Kr,bm,wm,Jr,jr,Tm,Am,Ye,tn,Gs=!1,Hn=ht.drag,Un=Hn.x,Fn=Hn.y;dt&&(ht.x&&(vf=Di(hA,g)),ht.y&&(Sf=Di(uA,g)),P.ori==0?($r=vf,Kr=Sf):($r=Sf,Kr=vf),Ye=ht.left,tn=ht.top);let Ze=n.select=bn({show:!0,over:!0,left:0,width:0,top:0,height:0},i.select),Qr=Ze.show?Di(cA,Ze.over?g:d):null;function kl(S,E){if(Ze.show){for(let F in S)Ze[F]=S[F],F in wf&&je(Qr,F,S[F]);E!==!1&&On("setSelect")}}n.setSelect=kl;function zy(S){if(_[S].show)Q&&Zp(ne[S],kr);else if(Q&&Ti(ne[S],kr),dt){let F=Ct?ce[0]:ce[S];F!=null&&_s(F,-10,-10,V,Rt)}}function Hs(S,E,F){yf(S,{min:E,max:F})}function ts(S,E,F,B){E.focus!=null&&Wy(S),E.show!=null&&_.forEach((W,K)=>{K>0&&(S==K||S==null)&&(W.show=E.show,zy(K),s==2?(Hs(W.facets[0].scale,null,null),Hs(W.facets[1].scale,null,null)):Hs(W.scale,null,null),qn())}),F!==!1&&On("setSeries",S,E),B&&Ma("setSeries",n,S,E)}n.setSeries=ts;function ky(S,E){bn(w[S],E)}function Vy(S,E){S.fill=ye(S.fill||null),S.dir=be(S.dir,-1),E=E??w.length,w.splice(E,0,S)}function Gy(S){S==null?w.length=0:w.splice(S,1)}n.addBand=Vy,n.setBand=ky,n.delBand=Gy;function Hy(S,E){_[S].alpha=E,dt&&ce[S]!=null&&(ce[S].style.opacity=E),Q&&ne[S]&&(ne[S].style.opacity=E)}let Ms,Ws,gr,to={focus:!0};function Wy(S){if(S!=gr){let E=S==null,F=Ot.alpha!=1;_.forEach((B,W)=>{if(s==1||W>0){let K=E||W==0||W==S;B._focus=E?null:K,F&&Hy(W,K?1:Ot.alpha)}}),gr=S,F&&qn()}}Q&&jt&&ve(nx,Et,S=>{ht._lock||(Jt(S),gr!=null&&ts(null,to,!0,Sn.setSeries))});function es(S,E,F){let B=y[E];F&&(S=S/Ce-(B.ori==1?oe:Zt));let W=V;B.ori==1&&(W=Rt,S=W-S),B.dir==-1&&(S=W-S);let K=B._min,ot=B._max,ft=S/W,vt=K+(ot-K)*ft,Dt=B.distr;return Dt==3?aa(10,vt):Dt==4?CA(vt,B.asinh):Dt==100?B.bwd(vt):vt}function Xy(S,E){let F=es(S,T,E);return $i(F,t[0],un,fn)}n.valToIdx=S=>$i(S,t[0]),n.posToIdx=Xy,n.posToVal=es,n.valToPos=(S,E,F)=>y[E].ori==0?r(S,y[E],F?q:V,F?N:0):o(S,y[E],F?ct:Rt,F?A:0),n.setCursor=(S,E,F)=>{Ye=S.left,tn=S.top,_r(null,E,F)};function Em(S,E){je(Qr,sa,Ze.left=S),je(Qr,Rl,Ze.width=E)}function Cm(S,E){je(Qr,"top",Ze.top=S),je(Qr,Pl,Ze.height=E)}let ya=P.ori==0?Em:Cm,va=P.ori==1?Em:Cm;function qy(){if(Q&&ut.live)for(let S=s==2?1:0;S<_.length;S++){if(S==0&&he)continue;let E=ut.values[S],F=0;for(let B in E)Vt[S][F++].firstChild.nodeValue=E[B]}}function Mf(S,E){if(S!=null&&(S.idxs?S.idxs.forEach((F,B)=>{nt[B]=F}):LA(S.idx)||nt.fill(S.idx),ut.idx=nt[0]),Q&&ut.live){for(let F=0;F<_.length;F++)(F>0||s==1&&!he)&&Yy(F,nt[F]);qy()}pt=!1,E!==!1&&On("setLegend")}n.setLegend=Mf;function Yy(S,E){let F=_[S],B=S==0&&I==2?di:t[S],W;he?W=F.values(n,S,E)??se:(W=F.value(n,E==null?null:B[E],S,E),W=W==null?se:{_:W}),ut.values[S]=W}function _r(S,E,F){Tm=Ye,Am=tn,[Ye,tn]=ht.move(n,Ye,tn),ht.left=Ye,ht.top=tn,dt&&($r&&_s($r,Ln(Ye),0,V,Rt),Kr&&_s(Kr,0,Ln(tn),V,Rt));let B,W=un>fn;Ms=Ge,Ws=null;let K=P.ori==0?V:Rt,ot=P.ori==1?V:Rt;if(Ye<0||on==0||W){B=ht.idx=null;for(let ft=0;ft<_.length;ft++){let vt=ce[ft];vt!=null&&_s(vt,-10,-10,V,Rt)}jt&&ts(null,to,!0,S==null&&Sn.setSeries),ut.live&&(nt.fill(B),pt=!0)}else{let ft,vt,Dt;s==1&&(ft=P.ori==0?Ye:tn,vt=es(ft,T),B=ht.idx=$i(vt,t[0],un,fn),Dt=O(t[0][B],P,K,0));let Nt=-10,Ft=-10,re=0,we=0,Me=!0,me="",Kt="";for(let Xt=s==2?1:0;Xt<_.length;Xt++){let $e=_[Xt],ln=nt[Xt],Bn=ln==null?null:s==1?t[Xt][ln]:t[Xt][1][ln],Fe=ht.dataIdx(n,Xt,B,vt),cn=Fe==null?null:s==1?t[Xt][Fe]:t[Xt][1][Fe];if(pt=pt||cn!=Bn||Fe!=ln,nt[Xt]=Fe,Xt>0&&$e.show){let pi=Fe==null?-10:Fe==B?Dt:O(s==1?t[0][Fe]:t[Xt][0][Fe],P,K,0),ti=cn==null?-10:L(cn,s==1?y[$e.scale]:y[$e.facets[1].scale],ot,0);if(jt&&cn!=null){let Ci=P.ori==1?Ye:tn,Fi=Dn(Ot.dist(n,Xt,Fe,ti,Ci));if(Fi<Ms){let ns=Ot.bias;if(ns!=0){let mi=es(Ci,$e.scale),Ri=cn>=0?1:-1,Oi=mi>=0?1:-1;Oi==Ri&&(Oi==1?ns==1?cn>=mi:cn<=mi:ns==1?cn<=mi:cn>=mi)&&(Ms=Fi,Ws=Xt)}else Ms=Fi,Ws=Xt}}if(pt||Ct){let Ci,Fi;P.ori==0?(Ci=pi,Fi=ti):(Ci=ti,Fi=pi);let ns,mi,Ri,Oi,is,ei,gi=!0,xr=lt.bbox;if(xr!=null){gi=!1;let ni=xr(n,Xt);Ri=ni.left,Oi=ni.top,ns=ni.width,mi=ni.height}else Ri=Ci,Oi=Fi,ns=mi=lt.size(n,Xt);if(ei=lt.fill(n,Xt),is=lt.stroke(n,Xt),Ct)Xt==Ws&&Ms<=Ot.prox&&(Nt=Ri,Ft=Oi,re=ns,we=mi,Me=gi,me=ei,Kt=is);else{let ni=ce[Xt];ni!=null&&(qe[Xt]=Ri,jn[Xt]=Oi,cx(ni,ns,mi,gi),ax(ni,ei,is),_s(ni,Ni(Ri),Ni(Oi),V,Rt))}}}}if(Ct){let Xt=Ot.prox,$e=gr==null?Ms<=Xt:Ms>Xt||Ws!=gr;if(pt||$e){let ln=ce[0];ln!=null&&(qe[0]=Nt,jn[0]=Ft,cx(ln,re,we,Me),ax(ln,me,Kt),_s(ln,Ni(Nt),Ni(Ft),V,Rt))}}}if(Ze.show&&Gs)if(S!=null){let[ft,vt]=Sn.scales,[Dt,Nt]=Sn.match,[Ft,re]=S.cursor.sync.scales,we=S.cursor.drag;if(Un=we._x,Fn=we._y,Un||Fn){let{left:Me,top:me,width:Kt,height:Xt}=S.select,$e=S.scales[Ft].ori,ln=S.posToVal,Bn,Fe,cn,pi,ti,Ci=ft!=null&&Dt(ft,Ft),Fi=vt!=null&&Nt(vt,re);Ci&&Un?($e==0?(Bn=Me,Fe=Kt):(Bn=me,Fe=Xt),cn=y[ft],pi=O(ln(Bn,Ft),cn,K,0),ti=O(ln(Bn+Fe,Ft),cn,K,0),ya(Ki(pi,ti),Dn(ti-pi))):ya(0,K),Fi&&Fn?($e==1?(Bn=Me,Fe=Kt):(Bn=me,Fe=Xt),cn=y[vt],pi=L(ln(Bn,re),cn,ot,0),ti=L(ln(Bn+Fe,re),cn,ot,0),va(Ki(pi,ti),Dn(ti-pi))):va(0,ot)}else Tf()}else{let ft=Dn(Tm-bm),vt=Dn(Am-wm);if(P.ori==1){let re=ft;ft=vt,vt=re}Un=Hn.x&&ft>=Hn.dist,Fn=Hn.y&&vt>=Hn.dist;let Dt=Hn.uni;Dt!=null?Un&&Fn&&(Un=ft>=Dt,Fn=vt>=Dt,!Un&&!Fn&&(vt>ft?Fn=!0:Un=!0)):Hn.x&&Hn.y&&(Un||Fn)&&(Un=Fn=!0);let Nt,Ft;Un&&(P.ori==0?(Nt=Jr,Ft=Ye):(Nt=jr,Ft=tn),ya(Ki(Nt,Ft),Dn(Ft-Nt)),Fn||va(0,ot)),Fn&&(P.ori==1?(Nt=Jr,Ft=Ye):(Nt=jr,Ft=tn),va(Ki(Nt,Ft),Dn(Ft-Nt)),Un||ya(0,K)),!Un&&!Fn&&(ya(0,0),va(0,0))}if(Hn._x=Un,Hn._y=Fn,S==null){if(F){if(zm!=null){let[ft,vt]=Sn.scales;Sn.values[0]=ft!=null?es(P.ori==0?Ye:tn,ft):null,Sn.values[1]=vt!=null?es(P.ori==1?Ye:tn,vt):null}Ma(kp,n,Ye,tn,V,Rt,B)}if(jt){let ft=F&&Sn.setSeries,vt=Ot.prox;gr==null?Ms<=vt&&ts(Ws,to,!0,ft):Ms>vt?ts(null,to,!0,ft):Ws!=gr&&ts(Ws,to,!0,ft)}}pt&&(ut.idx=B,Mf()),E!==!1&&On("setCursor")}let Xs=null;Object.defineProperty(n,"rect",{get(){return Xs==null&&Sa(!1),Xs}});function Sa(S=!1){S?Xs=null:(Xs=g.getBoundingClientRect(),On("syncRect",Xs))}function Rm(S,E,F,B,W,K,ot){ht._lock||Gs&&S!=null&&S.movementX==0&&S.movementY==0||(bf(S,E,F,B,W,K,ot,!1,S!=null),S!=null?_r(null,!0,!0):_r(E,!0,!1))}function bf(S,E,F,B,W,K,ot,ft,vt){if(Xs==null&&Sa(!1),Jt(S),S!=null)F=S.clientX-Xs.left,B=S.clientY-Xs.top;else{if(F<0||B<0){Ye=-10,tn=-10;return}let[Dt,Nt]=Sn.scales,Ft=E.cursor.sync,[re,we]=Ft.values,[Me,me]=Ft.scales,[Kt,Xt]=Sn.match,$e=E.axes[0].side%2==1,ln=P.ori==0?V:Rt,Bn=P.ori==1?V:Rt,Fe=$e?K:W,cn=$e?W:K,pi=$e?B:F,ti=$e?F:B;if(Me!=null?F=Kt(Dt,Me)?a(re,y[Dt],ln,0):-10:F=ln*(pi/Fe),me!=null?B=Xt(Nt,me)?a(we,y[Nt],Bn,0):-10:B=Bn*(ti/cn),P.ori==1){let Ci=F;F=B,B=Ci}}vt&&(E==null||E.cursor.event.type==kp)&&((F<=1||F>=V-1)&&(F=Br(F,V)),(B<=1||B>=Rt-1)&&(B=Br(B,Rt))),ft?(bm=F,wm=B,[Jr,jr]=ht.move(n,F,B)):(Ye=F,tn=B)}let wf={width:0,height:0,left:0,top:0};function Tf(){kl(wf,!1)}let Pm,Im,Lm,Dm;function Nm(S,E,F,B,W,K,ot){Gs=!0,Un=Fn=Hn._x=Hn._y=!1,bf(S,E,F,B,W,K,ot,!0,!1),S!=null&&(ve(Vp,qp,Um,!1),Ma(tx,n,Jr,jr,V,Rt,null));let{left:ft,top:vt,width:Dt,height:Nt}=Ze;Pm=ft,Im=vt,Lm=Dt,Dm=Nt}function Um(S,E,F,B,W,K,ot){Gs=Hn._x=Hn._y=!1,bf(S,E,F,B,W,K,ot,!1,!0);let{left:ft,top:vt,width:Dt,height:Nt}=Ze,Ft=Dt>0||Nt>0,re=Pm!=ft||Im!=vt||Lm!=Dt||Dm!=Nt;if(Ft&&re&&kl(Ze),Hn.setScale&&Ft&&re){let we=ft,Me=Dt,me=vt,Kt=Nt;if(P.ori==1&&(we=vt,Me=Nt,me=ft,Kt=Dt),Un&&Hs(T,es(we,T),es(we+Me,T)),Fn)for(let Xt in y){let $e=y[Xt];Xt!=T&&$e.from==null&&$e.min!=Ge&&Hs(Xt,es(me+Kt,Xt),es(me,Xt))}Tf()}else ht.lock&&(ht._lock=!ht._lock,_r(E,!0,S!=null));S!=null&&(wn(Vp,qp),Ma(Vp,n,Ye,tn,V,Rt,null))}function Zy(S,E,F,B,W,K,ot){if(ht._lock)return;Jt(S);let ft=Gs;if(Gs){let vt=!0,Dt=!0,Nt=10,Ft,re;P.ori==0?(Ft=Un,re=Fn):(Ft=Fn,re=Un),Ft&&re&&(vt=Ye<=Nt||Ye>=V-Nt,Dt=tn<=Nt||tn>=Rt-Nt),Ft&&vt&&(Ye=Ye<Jr?0:V),re&&Dt&&(tn=tn<jr?0:Rt),_r(null,!0,!0),Gs=!1}Ye=-10,tn=-10,nt.fill(null),_r(null,!0,!0),ft&&(Gs=ft)}function Fm(S,E,F,B,W,K,ot){ht._lock||(Jt(S),xa(),Tf(),S!=null&&Ma(ix,n,Ye,tn,V,Rt,null))}function Om(){M.forEach(ZE),k(n.width,n.height,!0)}Vr(Yu,oa,Om);let eo={};eo.mousedown=Nm,eo.mousemove=Rm,eo.mouseup=Um,eo.dblclick=Fm,eo.setSeries=(S,E,F,B)=>{let W=Sn.match[2];F=W(n,E,F),F!=-1&&ts(F,B,!0,!1)},dt&&(ve(tx,g,Nm),ve(kp,g,Rm),ve(ex,g,S=>{Jt(S),Sa(!1)}),ve(nx,g,Zy),ve(ix,g,Fm),tm.add(n),n.syncRect=Sa);let Vl=n.hooks=i.hooks||{};function On(S,E,F){Qn?Ne.push([S,E,F]):S in Vl&&Vl[S].forEach(B=>{B.call(null,n,E,F)})}(i.plugins||[]).forEach(S=>{for(let E in S.hooks)Vl[E]=(Vl[E]||[]).concat(S.hooks[E])});let Bm=(S,E,F)=>F,Sn=bn({key:null,setSeries:!1,filters:{pub:px,sub:px},scales:[T,_[1]?_[1].scale:null],match:[mx,mx,Bm],values:[null,null]},ht.sync);Sn.match.length==2&&Sn.match.push(Bm),ht.sync=Sn;let zm=Sn.key,Af=uy(zm);function Ma(S,E,F,B,W,K,ot){Sn.filters.pub(S,E,F,B,W,K,ot)&&Af.pub(S,E,F,B,W,K,ot)}Af.sub(n);function $y(S,E,F,B,W,K,ot){Sn.filters.sub(S,E,F,B,W,K,ot)&&eo[S](null,E,F,B,W,K,ot)}n.pub=$y;function Ky(){Af.unsub(n),tm.delete(n),Nn.clear(),$p(Yu,oa,Om),c.remove(),Et?.remove(),On("destroy")}n.destroy=Ky;function Ef(){On("init",i,t),_a(t||i.data,!1),z[T]?yf(T,z[T]):xa(),it=Ze.show&&(Ze.width>0||Ze.height>0),tt=pt=!0,k(i.width,i.height)}return _.forEach(Xr),M.forEach(xs),e?e instanceof HTMLElement?(e.appendChild(c),Ef()):e(n,Ef):Ef(),n}Gn.assign=bn;Gn.fmtNum=am;Gn.rangeNum=Zu;Gn.rangeLog=Ju;Gn.rangeAsinh=rm;Gn.orient=Hr;Gn.pxRatio=Ce;Gn.join=zA;Gn.fmtDate=cm,Gn.tzDate=KA;Gn.sync=uy;{Gn.addGap=LE,Gn.clipGaps=tf;let i=Gn.paths={points:_y};i.linear=yy,i.stepped=UE,i.bars=FE,i.spline=BE}function gm(i,t,e){let n=Math.max(e,0);return[Math.max(t*1.05,-Math.max(1.5*n,-t/5)),Math.max(1.15*n,-t/15)]}function $E(i,t,e){return[Math.min(t*1.08,0),e>0?e*1.08:1]}function KE(i,t,e,n){let s=[];for(let r=Math.ceil(Math.log10(e)-1e-9);10**r<=n*1.0001;++r)s.push(10**r);return s}function JE({key:i,logarithmic:t,range:e}){return t?{distr:3,...e?{range:e}:{}}:{range:e??(i==="depth"?gm:$E)}}function Ul({scale:i,logarithmic:t},e){let n=s=>t?Math.max(s*i,.1):s*i;return Array.from(e,s=>s===null?null:n(s))}function jE(i){return i===null?"":i>=1e5?`${+(i/1e3).toPrecision(6)}k`:`${+i.toPrecision(6)}`}var pa=class{constructor(t,e,n){this.quantity=t,this.theme=e,this.curves=n,this.values=n.names.map((r,o)=>{let a=mt("span",{className:"value",title:r});return a.style.setProperty("--colour",n.colours[o]),a});let s=mt("div",{className:"plot-head",title:t.hint??""},mt("span",{className:"plot-name"},t.name),...this.values,mt("span",{className:"unit"},t.unit));this.box=mt("div",{className:"plot-box"}),this.root=mt("figure",{className:"plot"},s,this.box),e.onChange(()=>this.plot?.redraw(!1))}options(t,e){let{quantity:n,curves:s}=this,r={stroke:()=>this.theme.colour("--muted"),font:"11px system-ui, sans-serif",grid:{stroke:()=>this.theme.colour("--line"),width:1},ticks:{show:!1}};return{width:t,height:e,padding:[6,14,0,0],legend:{show:!1},cursor:{drag:{x:!1,y:!1},points:{show:!1},x:!1,y:!1},scales:{x:{time:!1,...s.xScale},y:JE(n)},axes:[{...r,size:22,space:50,...s.x},{...r,size:46,space:22,...n.logarithmic?{splits:KE}:{},values:(o,a)=>a.map(jE)}],hooks:s.hooks??{},series:[{},...s.series.map(o=>({width:1.4,points:{show:!1},paths:n.stepped?Gn.paths.stepped({align:1}):void 0,...o}))],bands:s.bands??[]}}fit(t){let{clientWidth:e,clientHeight:n}=this.box;e<50||n<40||(this.plot?this.plot.setSize({width:e,height:n}):this.plot=new Gn(this.options(e,n),t(),this.box))}write(t){let{key:e,scale:n,digits:s}=this.quantity;this.values.forEach((r,o)=>{r.textContent=Number.isFinite(t[o])?yr(t[o]*n,s):"–",r.classList.toggle("inside",e==="depth"&&t[o]>0)})}};function by(i,t,e){let n=[t,e].filter(s=>s!==null);return n.length>0?i(...n):null}var rf=class{constructor(t,e){this.keys=t,this.seconds=e,this.clear()}clear(){this.t=[],this.low=Object.fromEntries(this.keys.map(t=>[t,[]])),this.high=Object.fromEntries(this.keys.map(t=>[t,[]]))}take(t,e){t<this.t.at(-1)&&this.clear();let{t:n}=this;if(n.length>1&&t-n.at(-2)<.01){n[n.length-1]=t;for(let s of this.keys)this.low[s].push(by(Math.min,this.low[s].pop(),e[s][1])),this.high[s].push(by(Math.max,this.high[s].pop(),e[s][2]));return}this.t.push(t);for(let s of this.keys)this.low[s].push(e[s][1]),this.high[s].push(e[s][2]);this.forget(t-this.seconds)}forget(t){let e=this.t.findIndex(s=>s>=t);if(e<60)return;let n=this.keys.flatMap(s=>[this.low[s],this.high[s]]);for(let s of[this.t,...n])s.splice(0,e)}};var wy=10,QE="#dc2626",tC=[1,1.5,2,3,5,7.5,10],Ty={force:1,stretch:.1,depth:.1,contacts:2,late:10,energy:1};function of(i){if(!(i>0))return 0;let t=10**Math.floor(Math.log10(i));return t*tC.find(e=>e*t>=i*.9999)}function eC(i){return(t,e,n)=>{let s=Math.max(of(n),Ty[i]??0);return[-of(-e),s>0?s:1]}}function nC(i,t,e){let[n,s]=gm(i,t,e);return[-of(-(e<n?t:n)),Math.max(of(s),.1*Ty.depth)]}function iC(i,t,e){if(t===null)return[1,1e3];let n=10**Math.floor(Math.log10(t));return[n,Math.max(10**Math.ceil(Math.log10(e)),10*n)]}function sC(i){let t=[{key:"late",name:"Lateness",unit:"µs",scale:1e6,digits:1,hint:"Time from the planned start of a cycle to its start. Zero in virtual time."},{key:"energy",name:"Energy absorbed",unit:"mJ",scale:1e3,digits:1,hint:"Energy that the rendered torques have absorbed from arm and hand. Below zero they have given energy."}],e={time:iC,depth:nC};return[...kh(i),...t].map(n=>({...n,range:e[n.key]??eC(n.key)}))}var af=class{constructor(t,e){this.figures=sC(t).map(s=>this.makeFigure(s,e)),this.history=new rf(this.figures.map(({quantity:s})=>s.key),wy),this.root=mt("div",{className:"plots"},...this.figures.map(({root:s})=>s)),this.interval=33,this.drawnAt=0,new ResizeObserver(()=>this.fit()).observe(this.root),this.visible=new Set;let n=new IntersectionObserver(s=>s.forEach(({target:r,isIntersecting:o})=>this.visible[o?"add":"delete"](r)));for(let{root:s}of this.figures)n.observe(s)}makeFigure(t,e){let[n]=ds,s=t.key==="depth"?[{stroke:QE,width:2}]:[];return new pa(t,e,{names:["latest"],colours:[n],x:{values:(r,o)=>o.map(a=>a===0?"now":`${+a.toFixed(3)} s`)},xScale:{range:[-wy,0]},series:[{stroke:n},{stroke:n},...s],bands:[{series:[2,1],fill:`${n}55`}]})}table(t){let{t:e,low:n,high:s}=this.history,r=e.at(-1)??0,o=Ul(t,s[t.key]),a=t.key==="depth"?[Array.from(o,l=>l>0?l:null)]:[];return[Float64Array.from(e,l=>l-r),Ul(t,n[t.key]),o,...a]}fit(){for(let t of this.figures)t.fit(()=>this.table(t.quantity))}take(t){this.history.take(t.t,t.plots),this.latest=t.plots}draw(t){if(!(!this.latest||t-this.drawnAt<this.interval)){this.drawnAt=t;for(let e of this.figures)this.visible.has(e.root)&&(e.plot?.setData(this.table(e.quantity)),e.write([this.latest[e.quantity.key][0]]));this.latest=void 0}}};var lf=1e3,Fl=class{constructor(t,e,n,s){this.digits=n,this.act=s,this.slider=mt("input",{type:"range",min:0,max:lf,"aria-label":t,className:"own-keys",oninput:()=>this.drag(),onchange:()=>this.choose(this.number.valueAsNumber)}),this.number=mt("input",{type:"number",min:0,step:"any","aria-label":`${t}, ${e}`,className:"own-keys",oninput:()=>this.isEdited=!0,onchange:()=>this.choose(this.number.valueAsNumber)}),this.track=mt("div",{className:"bounded"},this.slider),this.root=mt("div",{className:"row quantity"},mt("span",{className:"quantity-name"},t),this.track,this.number,mt("span",{className:"unit"},e))}drag(){this.isEdited=!0,this.number.value=(this.slider.valueAsNumber/lf*this.top).toFixed(this.digits)}choose(t){if(this.isEdited=!1,!(t>=0)){this.write();return}this.slider.value=String(lf*t/this.top),this.act(t)}settle(){this.isEdited||this.write()}show(t,e){this.value=t;let n=1.02*Math.max(t,e??0);this.top>=n||(this.top=Math.max(1.5*(e??0),2*t,10**-this.digits)),this.track.style.setProperty("--boundary",String(e===null?1:e/this.top)),this.track.classList.toggle("has-boundary",e!==null),!this.isEdited&&document.activeElement!==this.number&&this.write()}write(){this.number.value=this.value.toFixed(this.digits),this.slider.value=String(lf*this.value/this.top)}};function rC(i,t){let e=mt("input",{type:"checkbox",onchange:()=>t(e.checked)});return{input:e,label:mt("label",{},e,` ${i}`)}}var cf=class{constructor(t){this.send=t,this.solvers=mt("div",{className:"solvers",role:"group","aria-label":"Solver"}),this.friction=rC("Friction",e=>this.set({friction:e})),this.stiffness=new Fl("Stiffness","N/m",0,e=>this.set({stiffness:e})),this.damping=new Fl("Damping","Ns/m",1,e=>this.set({damping:e})),this.limit=mt("p",{className:"limit"}),this.refusal=mt("span"),this.anyway=mt("button",{type:"button",className:"wide",onclick:()=>this.tryAnyway()},"Try in simulation anyway"),this.answer=mt("div",{className:"refusal",role:"alert",hidden:!0},this.refusal,this.anyway),this.root=mt("section",{className:"settings",hidden:!0,"aria-label":"Settings"},mt("div",{className:"row"},this.solvers,this.friction.label),this.stiffness.root,this.damping.root,this.limit,this.answer)}set(t){this.asked=t,this.answer.hidden=!0,this.send({type:"set",...t})}tryAnyway(){this.set({...this.asked,beyond:!0})}take({ok:t,text:e}){if(!this.asked)return!1;let{stiffness:n,damping:s,beyond:r}=this.asked;return this.refusal.textContent=e??"",this.answer.hidden=t,this.anyway.hidden=r===!0||n===void 0&&s===void 0,t&&(this.asked=void 0),this.stiffness.settle(),this.damping.settle(),this.shown=void 0,!0}show(t){this.root.hidden=!t;let e=JSON.stringify(t);!t||e===this.shown||(this.shown=e,this.showSolvers(t),this.friction.label.hidden=!t.has_friction,this.friction.input.checked=t.friction,this.stiffness.show(t.stiffness,t.boundary),this.damping.show(t.damping,null),this.showLimit(t))}showSolvers({solver:t,solvers:e}){this.solvers.children.length!==e.length&&this.solvers.replaceChildren(...e.map(n=>mt("button",{type:"button",onclick:()=>this.set({solver:n})},n)));for(let n of this.solvers.children){let s=n.textContent===t;n.classList.toggle("on",s),n.setAttribute("aria-pressed",String(s))}}showLimit({boundary:t,beyond:e}){let n=t===null?"":`${Math.round(t).toLocaleString("en")} N/m`;this.limit.classList.toggle("beyond",e),this.limit.textContent=e?`Beyond the stability boundary${n&&` of ${n}`}: the hand may shake.`:n&&`Stable up to ${n}.`}};var oC=60;function _m(i,t,e){return i.map((n,s)=>n+e*(t[s]-n))}function Ay(i,t,e){let[n,s]=[i,t].map(([,,,c,f,u,h])=>new en(f,u,h,c)),{w:r,x:o,y:a,z:l}=n.slerp(s,e);return[..._m(i.slice(0,3),t.slice(0,3),e),r,o,a,l]}var hf=class{take(t,e){[...t.device,...t.god].every(Number.isFinite)&&(this.from=this.latest?this.at(e):t,this.span=this.latest?Math.min(e-this.arrived,oC):0,this.latest=t,this.arrived=e,this.settled=!1)}at(t){let e=this.span>0?Math.min((t-this.arrived)/this.span,1):1;if(this.settled=e===1,this.settled)return this.latest;let{from:n,latest:s}=this;return{device:Ay(n.device,s.device,e),god:Ay(n.god,s.god,e),force:_m(n.force,s.force,e),torque:_m(n.torque,s.torque,e)}}};var aC=[{vendorId:9583},{vendorId:1133,usagePage:1,usage:8}],lC=350,cC=.05,Ey=200,Ol=class{static isPossible(){return!!navigator.hid}constructor(){this.axes=[0,0,0,0,0,0]}async connect(){let[t]=await navigator.hid.requestDevice({filters:aC});if(t)return t.opened||await t.open(),t.addEventListener("inputreport",({reportId:e,data:n})=>this.read(e,n)),t.productName}read(t,e){if(t!==1&&t!==2)return;let n=t===1?0:3;for(let s=0;s<Math.min(e.byteLength>>1,6-n);++s)this.axes[n+s]=e.getInt16(2*s,!0)/lC;this.heard=performance.now()}rates(){if(performance.now()-(this.heard??-Ey)>=Ey)return[0,0,0,0,0,0];let[t,e,n,s,r,o]=this.axes.map(a=>Math.abs(a)<cC?0:a);return[t,-n,-e,s,-o,-r]}};var hC={free:"nobody moves the hand",yours:"you move the hand",other:"another viewer moves the hand"},uC=100;function Wr(i,t){i.textContent!==t&&(i.textContent=t)}function fC({mode:i,share:t}){return i==="engaging"?`${i} ${Math.round(100*t)} %`:i}var uf=class{constructor(t,e){this.steers=e,this.label=new ml(t,ds[0]),this.mode=mt("span",{className:"mode"}),this.label.state.before(this.mode),this.root=mt("div",{className:"labels"},this.label.root),this.facts=Object.fromEntries(["time","speed","cycles","lost","hand","viewers"].map(n=>[n,mt("span",{className:`fact ${n}`})])),this.line=mt("div",{className:"facts"},...Object.values(this.facts))}place([{width:t}]){Object.assign(this.label.root.style,{left:"8px",top:"8px",maxWidth:`${t-16}px`})}show(t){Wr(this.mode,fC(t)),this.mode.dataset.kind=t.fault?"fault":t.mode==="running"?"running":"waiting",this.label.show(t.outcome),performance.now()-(this.wroteAt??0)>=uC&&this.showFacts(t)}showFacts(t){this.wroteAt=performance.now();let{time:e,speed:n,cycles:s,lost:r,hand:o,viewers:a}=this.facts;Wr(e,`${yr(t.t,1)} s`),Wr(n,`${yr(t.speed,2)} × real time`),Wr(s,`${t.cycles.toLocaleString("en")} cycles`),Wr(r,t.lost?`${t.lost.toLocaleString("en")} lost`:""),Wr(o,this.steers?hC[t.hand]??"":""),Wr(a,`${t.viewers} ${t.viewers===1?"viewer":"viewers"}`)}};var dC=1/3,pC=1,mC=.25,xm=.15,Cy={ArrowRight:[1,0,0],ArrowLeft:[-1,0,0],ArrowUp:[0,1,0],ArrowDown:[0,-1,0],PageUp:[0,0,1],PageDown:[0,0,-1]},gC={ArrowRight:[0,1,0],ArrowLeft:[0,-1,0],ArrowUp:[-1,0,0],ArrowDown:[1,0,0],PageUp:[0,0,1],PageDown:[0,0,-1]},ff=class{constructor(){this.held=new Set,addEventListener("keydown",t=>{this.shift=t.shiftKey,!(!(t.key in Cy)||ip(t))&&(t.preventDefault(),this.held.add(t.key))}),addEventListener("keyup",t=>{this.shift=t.shiftKey,this.held.delete(t.key)}),addEventListener("blur",()=>this.held.clear())}rates(){let t=[0,0,0,0,0,0],[e,n]=this.shift?[gC,3]:[Cy,0];for(let s of this.held)e[s].forEach((r,o)=>t[n+o]+=r);return t}};function Ry(i=0){return Math.abs(i)<xm?0:(i-Math.sign(i)*xm)/(1-xm)}var df=class{rates(){let t=navigator.getGamepads?.().find(a=>a);if(!t)return[0,0,0,0,0,0];let[e,n,s,r]=[0,1,2,3].map(a=>Ry(t.axes[a])),o=a=>Ry(t.buttons[a]?.value);return[e,-n,o(7)-o(6),r,s,o(5)-o(4)]}},pf=class{constructor(t,e,n,s){Object.assign(this,{picture:t,hand:e,instruments:n,mayGrab:s}),this.idle=0}advance(t){let{hand:e}=this,n=[0,0,0,0,0,0];for(let s of this.instruments)s.rates().forEach((r,o)=>n[o]+=r);this.idle=n.some(s=>s!==0)?0:this.idle+t,this.idle===0&&!e.holder&&this.mayGrab()&&e.grab("steering"),e.holder==="steering"&&(this.idle>mC?e.release():this.moveBy(n.map(s=>Math.min(Math.max(s,-1),1)*t)))}moveBy(t){let e=2*this.picture.distance*Math.sin(this.picture.data.camera.half_view);Or(this.picture.camera).forEach((n,s)=>{this.hand.rotate(n,pC*t[3+s]),this.hand.move(n.multiplyScalar(dC*e*t[s]))})}};var _C={device:[0,0,0,1,0,0,0],god:[0,0,0,1,0,0,0],force:[0,0,0],torque:[0,0,0]};function xC({still:{low:i,high:t},moving:e},n){let s=new U(...e.high).distanceTo(new U(...e.low));return Math.min(i[n],(i[n]+t[n]-s)/2)}function yC(i,t,e){let{force:n,torque:s}=i.live,r=Cu(i,t,{count:1,largest:{force:n,torque:s},lowest:a=>xC(i,a)});if(!r)return{};r.show([_C]),t.append(Gh(i,r.stage.gridStep,["god object","contact point"]));let o=new Vu(r,n);return e.onChange(()=>o.setDark(e.dark)),o.setDark(e.dark),{picture:r,objects:o}}function vC(i,t){let{live:e}=i,n=new Lu,s=v=>n.send(v),r=new Vo,o=mt("div",{className:"view"}),{picture:a,objects:l}=yC(i,o,r),c=new uf(e.source,e.hand);c.root.classList.toggle("alone",!a);let f=new Gu(()=>s({type:"reset"})),u=new Fu(e.hand),h=new ia(a,r,t),d=new cf(s),g=new af(e.torque,r);return o.append(c.root,f.root,u.root),t.classList.add("live"),t.append(mt("section",{className:"frame"},o,c.line,h.root),mt("div",{className:"side"},d.root,g.root)),{data:i,root:t,connection:n,theme:r,view:o,picture:a,objects:l,line:c,notices:f,help:u,options:h,settings:d,plots:g}}function SC(i){let{data:t,connection:e,picture:n,view:s,notices:r,options:o}=i,a=n.size,l=new Uu(new U(...t.moving.centre),a,d=>e.send(d)),c=()=>e.online&&i.latest.hand!=="other",f=new Nu(n,l,s,c),u=[new ff,new df],h=new pf(n,l,u,c);return r.showHint(`Drag ${t.moving.name} to move the hand`),l.onGrab=()=>r.showHint(""),document.addEventListener("visibilitychange",()=>document.hidden&&l.release()),Ol.isPossible()&&o.addButton("Connect SpaceMouse",()=>MC(u,r)),{hand:l,grab:f,steering:h}}async function MC(i,t){let e=new Ol;try{let n=await e.connect();if(n===void 0)return;i.push(e),t.tell(`${n} moves the hand.`)}catch(n){t.tell(`The SpaceMouse cannot be opened: ${n.message}`)}}function bC({options:i,objects:t}){let e=i.addBox("Arm","Show the arm (a)",n=>t.showArm(n));return e.checked=!0,()=>e.click()}function wC(){let i;return({device:t,god:e,force:n,torque:s,points:r,arm:o})=>{let a=JSON.stringify([t,e,n,s,r,o]),l=a!==i;return i=a,l}}function TC(i,t){let{connection:e,root:n,notices:s,settings:r,line:o,plots:a,objects:l,hand:c}=i,f=wC();e.onState=u=>{f(u)&&(t.take(u,performance.now()),l?.show(u)),i.latest=u,t.latest&&c?.follow(t.latest.device),u.hand==="other"&&c?.drop(),o.show(u),s.showFault(u.fault),r.show(u.settings),a.take(u)},e.onAnswer=u=>{r.take(u)||u.ok||(s.tell(u.text),c?.drop())},e.onChange=u=>{n.classList.toggle("offline",!u),s.showConnection(u?"":"No connection to the controller. Trying again every second."),u||c?.drop()},e.open()}function Py(i,t){let e=vC(i,t),{picture:n,plots:s,objects:r,options:o,help:a,line:l,view:c,theme:f}=e,u=new hf,h={...np(e),h:()=>a.toggle(),"?":()=>a.toggle()};o.addButton("?",()=>a.toggle()),n&&(h.a=bC(e),i.live.hand&&Object.assign(e,SC(e)),Ru(n,l,c,f)),zh(h),TC(e,u),window.godobjectPage=e;let d=new Du(n,s);Pu(g=>{let v=performance.now();d.advance(g),e.steering?.advance(g),n&&(u.latest&&!u.settled&&n.show([u.at(v)]),r.showBand(e.grab?.band()),n.draw()),s.draw(v)})}var Iy=`.boxes { display: inline-flex; gap: 14px; }
.boxes:empty { display: none; }
.side { display: flex; flex-direction: column; gap: 10px; min-width: 0; }
.key.contact-point::before { background: #fde047; border: 2px solid #111827; border-radius: 50%; }
.mode { padding: 0 8px; border-radius: 9px; background: var(--free); color: #fff; font-size: 12px; font-weight: 600; }
.mode[data-kind='running'] { background: var(--contact); }
.mode[data-kind='fault'] { background: var(--bad-input); }
.mode:empty, .state:empty { display: none; }
.picture.over-body { cursor: move; }
.facts { display: flex; flex-wrap: wrap; gap: 2px 16px; padding: 7px 12px; border-top: 1px solid var(--line); font-size: 13px;
  color: var(--muted); font-variant-numeric: tabular-nums; min-height: 34px; }
.fact:empty { display: none; }
.fact.time { color: var(--text); font-weight: 600; min-width: 62px; }
.fact.hand { margin-left: auto; color: var(--text); }
.fact.lost { color: var(--overflow); }
.notices { position: absolute; left: 0; right: 0; top: 46px; display: grid; gap: 8px; justify-items: center; padding: 0 12px;
  pointer-events: none; }
.notice { display: flex; align-items: center; gap: 12px; padding: 7px 14px; border-radius: 10px; font-size: 14px;
  max-width: 100%; background: var(--panel); border: 1px solid var(--line); box-shadow: 0 2px 10px #0002; overflow-wrap: anywhere; }
.notice[hidden], .connection:not([hidden]) ~ .hint, .fault:not([hidden]) ~ .hint { display: none; }
.notice.fault { background: #dc2626; border-color: #dc2626; color: #fff; font-weight: 600; pointer-events: auto; }
.notice.hint { background: var(--accent); border-color: var(--accent); color: #fff; font-weight: 600; }
:root[data-theme='dark'] .notice.hint { color: #0b1220; }
button.wide { width: auto; padding: 0 14px; font-weight: 600; }
button.text { width: auto; padding: 0 11px; }
.offline .picture, .offline .plots { filter: grayscale(1) opacity(0.55); }
.offline .mode, .offline .state { background: var(--free); }
.help { position: absolute; right: 8px; top: 46px; max-width: min(440px, calc(100% - 16px)); max-height: calc(100% - 54px);
  overflow: auto; padding: 10px 16px; border-radius: 10px; background: var(--panel); border: 1px solid var(--line);
  box-shadow: 0 4px 18px #0003; font-size: 13px; }
.help[hidden], .view:has(.help:not([hidden])) .hint { display: none; }
.help dl { display: grid; grid-template-columns: auto minmax(0, 1fr); gap: 4px 14px; margin: 0; }
.help dt { font-weight: 600; white-space: pre; }
.help dd { margin: 0; color: var(--muted); }
.settings { display: grid; gap: 8px; padding: 10px 12px; background: var(--panel); border: 1px solid var(--line); border-radius: 10px;
  font-size: 13px; }
.settings[hidden] { display: none; }
.row { display: flex; flex-wrap: wrap; align-items: center; gap: 6px 12px; }
.row label { margin-left: auto; }
.row label[hidden] { display: none; }
.solvers { display: flex; }
.solvers button { width: auto; padding: 0 12px; border-radius: 0; margin-left: -1px; }
.solvers button:first-child { border-radius: 8px 0 0 8px; margin-left: 0; }
.solvers button:last-child { border-radius: 0 8px 8px 0; }
.solvers button.on { background: var(--accent); border-color: var(--accent); color: #fff; font-weight: 600; }
:root[data-theme='dark'] .solvers button.on { color: #0b1220; }
.quantity { flex-wrap: nowrap; }
.quantity-name { width: 62px; font-weight: 600; }
.quantity .unit { padding: 0; }
.quantity input[type='number'] { width: 84px; height: 32px; border: 1px solid var(--line); border-radius: 8px; background: var(--panel);
  color: var(--text); font: inherit; padding: 0 6px; text-align: right; }
.bounded { position: relative; flex: 1; min-width: 60px; display: grid; align-items: center; }
.bounded input { width: 100%; }
/* The part beyond the boundary, and a mark at it. The slider's thumb is 16 px wide. */
.bounded.has-boundary::before { content: ''; position: absolute; left: calc(8px + (100% - 16px) * var(--boundary)); right: 0;
  height: 16px; border-left: 2px solid #dc2626; border-radius: 0 6px 6px 0; background: #dc262626; pointer-events: none; }
.limit { margin: 0; color: var(--muted); }
.limit:empty { display: none; }
.limit.beyond { color: #dc2626; font-weight: 600; }
:root[data-theme='dark'] .limit.beyond { color: #f87171; }
.refusal { display: flex; flex-wrap: wrap; align-items: center; gap: 8px 12px; padding: 8px 10px; border-radius: 8px;
  border: 1px solid var(--cut); background: color-mix(in srgb, var(--cut) 14%, transparent); overflow-wrap: anywhere; }
.refusal[hidden], .refusal [hidden] { display: none; }
@media (min-width: 1000px) {
  #player.live .side { height: max(756px, calc(100vh - 105px)); }
  #player.live .plots { grid-template-columns: repeat(2, minmax(0, 1fr)); height: 0; flex: 1; }
  #player.live:fullscreen .side { height: max(756px, calc(100vh - 24px)); }
}
@media (max-width: 999px) {
  #player.live button { height: 42px; min-width: 42px; }
  #player.live select, #player.live .quantity input[type='number'] { height: 42px; }
  #player.live input[type='checkbox'] { width: 20px; height: 20px; }
  #player.live .bounded input { height: 32px; }
}
@media (max-width: 639px) {
  .live .notices { top: 70px; }
  .live .help { top: 8px; max-height: calc(100% - 16px); }
  .live .fact.hand { margin-left: 0; }
  .live .words { display: none; }
  .live .view { height: 56vh; }
  .fact.cycles { display: none; }
}
.live .plot-head { flex-wrap: nowrap; }
.live .plot-name { overflow: hidden; text-overflow: ellipsis; white-space: nowrap; min-width: 0; }
.live .unit { min-width: 34px; flex: none; }
.live .value { flex: none; white-space: nowrap; }
`;async function EC(i){let t=Uint8Array.from(atob(i),n=>n.charCodeAt(0)),e=new Blob([t]).stream().pipeThrough(new DecompressionStream("deflate"));return new Uint8Array(await new Response(e).arrayBuffer())}function CC(i,{offset:t,count:e}){let n=new Int32Array(e),s=0;for(let r=0;r<e;++r){let o=t+r,a=i[o]|i[o+e]<<8|i[o+2*e]<<16|i[o+3*e]<<24;s=s+(a>>>1^-(a&1))|0,n[r]=s}return n}function ym(i,t){if(Array.isArray(i))return i.map(e=>ym(e,t));if(i===null||typeof i!="object")return i;if("offset"in i&&"count"in i){let e=CC(t,i);return i.step===1?e:Float64Array.from(e,n=>n*i.step)}return Object.fromEntries(Object.entries(i).map(([e,n])=>[e,ym(n,t)]))}async function vm(i){let t=await EC(i.textContent),e=new DataView(t.buffer).getUint32(0,!0),n=JSON.parse(new TextDecoder().decode(t.subarray(4,4+e)));return ym(n,t.subarray(4+e))}function Ly(i,t,e){let n=new URLSearchParams(location.hash.slice(1));n.has("t")&&i.seekTime(Number(n.get("t"))||0);let s=["x","y","z"].indexOf(n.get("cut"));e&&s>=0&&t.cutAcross(s,n.has("both")),e&&n.has("distance")&&t.showDistance(!0);let r=Number(n.get("speed"));Fr.includes(r)&&i.setSpeed(r),i.playing=!n.has("paused")}var mf=class{constructor(t){this.times=t,this.sample=0,this.time=t[0],this.playing=!1,this.loops=!1,this.speed=1,this.listeners=[]}get last(){return this.times.length-1}onChange(t){this.listeners.push(t)}changed(){for(let t of this.listeners)t(this.sample)}seekSample(t){this.sample=Math.min(Math.max(Math.round(t),0),this.last),this.time=this.times[this.sample],this.changed()}seekTime(t){this.seekSample(this.sampleAt(t))}sampleAt(t){let e=0,n=this.last;for(;e<n;){let s=e+n+1>>1;this.times[s]<=t?e=s:n=s-1}return e}step(t){this.playing=!1,this.seekSample(this.sample+t)}toggle(){this.playing=!this.playing,this.playing&&this.sample===this.last?this.seekSample(0):this.changed()}setSpeed(t){this.speed=t,this.changed()}advance(t){if(!this.playing)return;this.time+=t*this.speed;let e=this.times[this.last];this.time>=e&&(this.loops?this.time=this.times[0]:(this.time=e,this.playing=!1)),this.sample=this.sampleAt(this.time),this.changed()}};var RC="#dc2626";function PC(i){if(i.bucket===1)return i.t;let t=new Float64Array(2*i.t.length);for(let e=0;e<i.t.length;++e){let n=e+1<i.t.length?i.t[e+1]:i.t[e]+(i.t[e]-i.t[Math.max(e-1,0)]);t[2*e]=i.t[e],t[2*e+1]=(i.t[e]+n)/2}return t}function IC(i){return Array.from(i,(t,e)=>t>0||i[e-1]>0||i[e+1]>0?t:null)}var gf=class{constructor(t,e,n,s){this.data=t,this.clock=n,this.times=PC(t),this.entries=e.map(r=>this.makeEntry(r,s)),this.root=mt("div",{className:"plots"},...this.entries.map(({figure:r})=>r.root)),new ResizeObserver(()=>this.resize()).observe(this.root)}makeEntry(t,e){let n=this.data.replays.map((r,o)=>ds[o]),s={line:mt("div",{className:"now"})};return s.figure=new pa(t,e,{names:this.data.replays.map(({name:r})=>r),colours:n,x:{values:(r,o)=>o.map(a=>`${+a.toFixed(6)} s`)},hooks:{draw:[()=>this.placeLine(s)]},series:[...n,...t.key==="depth"?n.map(()=>RC):[]].map(r=>({stroke:r}))}),s}table(t){let e=this.data.replays.map(({plots:n})=>{let{extremes:s,values:r}=n[t.key];return Ul(t,s??r)});return[this.times,...e,...t.key==="depth"?e.map(IC):[]]}resize(){for(let{figure:t,line:e}of this.entries){let n=!t.plot;t.fit(()=>this.table(t.quantity)),n&&t.plot&&this.seekIn(t.plot,e)}this.show(this.clock.sample)}seekIn(t,e){t.over.append(e);let n=s=>{let r=s.clientX-t.over.getBoundingClientRect().left;this.clock.seekTime(t.posToVal(r,"x"))};t.over.addEventListener("pointerdown",s=>{t.over.setPointerCapture(s.pointerId),n(s)}),t.over.addEventListener("pointermove",s=>s.buttons&1&&n(s))}show(t){for(let e of this.entries)e.figure.write(this.data.replays.map(({plots:n})=>n[e.figure.quantity.key].values[t])),this.placeLine(e)}placeLine({figure:t,line:e}){t?.plot&&(e.style.transform=`translateX(${t.plot.valToPos(this.data.t[this.clock.sample],"x")}px)`)}};function Dy(i,t){let e=0;for(let{[t]:[n,s,r]}of i)for(let o=0;o<n.length;++o)e=Math.max(e,Math.hypot(n[o],s[o],r[o]));return e||1}function Ny({replays:i}){return{force:Dy(i,"force"),torque:Dy(i,"torque")}}function Uy(i,t){let{low:e,high:n,centre:s}=i.moving,r=Math.hypot(...e.map((a,l)=>Math.max(n[l]-s[l],s[l]-e[l]))),o=i.still.low[t];for(let{pose:a,status:l}of i.replays)for(let c=0;c<i.t.length;++c)i.statuses[l[c]]!=="free"&&(o=Math.min(o,a[t][c]+s[t]-r));return o}function Sm(i,t){let e=s=>s.map(r=>r[t]),n=e(i.device);return i.replays.map(({pose:s,force:r,torque:o})=>({device:n,god:e(s),force:e(r),torque:e(o)}))}var _f=class{constructor(t,e){this.data=t,this.theme=e,this.root=mt("canvas",{className:"band"}),e.onChange(()=>this.draw()),new ResizeObserver(()=>this.draw()).observe(this.root)}draw(){let{root:t,data:e}=this,n=Math.round(t.clientWidth*devicePixelRatio),s=Math.round(t.clientHeight*devicePixelRatio);if(!n||!s)return;t.width=n,t.height=s;let r=t.getContext("2d"),o=e.statuses.map(f=>this.theme.colour(`--${f.replace("_","-")}`)||"#888"),a=e.t.length,l=e.t[a-1]-e.t[0]||1,c=f=>(e.t[f]-e.t[0])/l*n;e.replays.forEach(({status:f},u)=>{let h=Math.round(u*s/e.replays.length),d=Math.round((u+1)*s/e.replays.length)-(u+1<e.replays.length?1:0);for(let g=0,v=0;g<a;++g){if(g+1<a&&f[g+1]===f[g])continue;r.fillStyle=o[f[g]];let m=g+1<a?c(g+1):n;r.fillRect(c(v),h,Math.max(m-c(v),devicePixelRatio),d-h),v=g+1}})}};var LC=.15;function Oy(i){let t=i.statuses.indexOf("free"),e=i.replays.map(({status:n})=>n.findIndex(s=>s!==t));return Math.min(...e.map(n=>n<0?0:n))}function Fy(i,t){return Math.max(...i.replays.map(({plots:e})=>e[t].values.reduce((n,s)=>Math.max(n,s),0)))}function DC(i){return kh(Fy(i,"torque")).filter(({key:e})=>e!=="time"||Fy(i,"time")>0)}function NC(i,t){let e=new Vo,n=new mf(i.t),s=mt("div",{className:"view"}),r=mt("section",{className:"frame"},s);t.append(r),t.classList.toggle("several",i.replays.length>1),t.style.setProperty("--count",i.replays.length);let o=Cu(i,s,{count:i.replays.length,largest:Ny(i),lowest:u=>Uy(i,u)});o?.show(Sm(i,Oy(i)));let a=new Vh(i);a.root.classList.toggle("alone",!o),s.append(a.root),o&&s.append(Gh(i,o.stage.gridStep,i.replays.length===1?["god object"]:[]));let l=new Iu(n,new _f(i,e).root),c=new ia(o,e,t),f=new gf(i,DC(i),n,e);return r.append(l.root,c.root),t.append(f.root),{theme:e,clock:n,view:s,picture:o,labels:a,transport:l,options:c,plots:f}}function By(i,t){let e=NC(i,t),{theme:n,clock:s,view:r,picture:o,labels:a,options:l,plots:c}=e;for(let f of[a,c])s.onChange(u=>f.show(u));o&&(s.onChange(f=>o.show(Sm(i,f))),Ru(o,a,r,n)),s.setSpeed(q_(i.t[s.last]-i.t[0])),s.seekTime(i.t[Oy(i)]-LC),Ly(s,l,o),s.changed(),zh(G0(e)),window.godobjectPage={data:i,clock:s,picture:o},Pu(f=>{s.advance(f),o?.draw()})}async function UC(){document.head.append(mt("style",{},Vm,Gm,Iy));let i=document.getElementById("player"),t=document.getElementById("live-data");t?Py(await vm(t),i):By(await vm(document.getElementById("replay-data")),i)}UC().catch(i=>{throw document.getElementById("player").append(`The page cannot be shown: ${i.message}. A current version of Firefox, Chrome, Edge or Safari shows it.`),i});})();
