// SPDX-License-Identifier: MIT
// browser.mjs - a headless Chromium, driven through a pipe (its DevTools protocol), without any package.
import {spawn, spawnSync} from 'node:child_process';
import {mkdtempSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';

const ANSWER = 30000; // ms for one command: a frozen page fails the test, it does not hang it

export function findChromium() {
  return ['chromium', 'chromium-browser', 'google-chrome'].find(name => spawnSync(name, ['--version']).status === 0);
}

export class Browser {
  events = []; // what the page did by itself: console, exceptions, requests
  #waiting = new Map();
  #id = 0;
  #rest = '';

  static async start(program) {
    const b = new Browser();
    b.home = mkdtempSync(join(tmpdir(), 'page-'));
    b.process = spawn(program, ['--headless=new', '--no-sandbox', '--disable-gpu', '--remote-debugging-pipe',
      '--user-data-dir=' + b.home, 'about:blank'], {stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe']});
    b.process.stdio[4].on('data', data => b.#receive(data));
    const {targetInfos} = await b.send('Target.getTargets');
    const {targetId} = targetInfos.find(t => t.type === 'page');
    b.session = (await b.send('Target.attachToTarget', {targetId, flatten: true})).sessionId;
    for (const domain of ['Page', 'Runtime', 'Log', 'Network']) await b.send(domain + '.enable');
    await b.send('Emulation.setScrollbarsHidden', {hidden: true});
    return b;
  }

  #receive(data) {
    const messages = (this.#rest + data).split('\0');
    this.#rest = messages.pop();
    for (const m of messages.map(JSON.parse)) {
      if (m.id) this.#waiting.get(m.id)(m);
      else this.events.push(m);
    }
  }

  send(method, params = {}) {
    const id = ++this.#id, message = {id, method, params};
    if (this.session) message.sessionId = this.session;
    return new Promise((done, fail) => {
      const late = setTimeout(() => fail(new Error(`${method}: no answer in ${ANSWER / 1000} s`)), ANSWER);
      this.#waiting.set(id, m => {
        clearTimeout(late);
        if (m.error) fail(new Error(`${method}: ${m.error.message}`));
        else done(m.result);
      });
      this.process.stdio[3].write(JSON.stringify(message) + '\0');
    });
  }

  async value(expression) {
    const {result, exceptionDetails} = await this.send('Runtime.evaluate', {expression, returnByValue: true, awaitPromise: true});
    if (exceptionDetails) throw new Error(`${expression.slice(0, 80)}: ${exceptionDetails.exception?.description}`);
    return result.value;
  }

  async until(expression) {
    for (let tries = 0; tries < 200; tries++) {
      if (await this.value(expression)) return true;
      await new Promise(done => setTimeout(done, 50));
    }
    return false;
  }

  async open(address, ready) {
    await this.send('Page.navigate', {url: 'about:blank'});
    await this.send('Page.navigate', {url: address});
    return this.until(ready);
  }

  size(width, height, mobile) {
    return this.send('Emulation.setDeviceMetricsOverride', {width, height, mobile, deviceScaleFactor: mobile ? 2 : 1});
  }

  media(features) { // of style sheets, as {name: value}
    const list = Object.entries(features).map(([name, value]) => ({name, value}));
    return this.send('Emulation.setEmulatedMedia', {features: list});
  }

  async key(name, code) {
    for (const type of ['keyDown', 'keyUp'])
      await this.send('Input.dispatchKeyEvent', {type, key: name, code: name, windowsVirtualKeyCode: code});
  }

  // The whole page, or a part {x, y, width, height, scale} of it.
  async picture(file, clip) {
    const {data} = await this.send('Page.captureScreenshot', {clip, captureBeyondViewport: true});
    writeFileSync(file, Buffer.from(data, 'base64'));
  }

  async stop() {
    const gone = new Promise(done => this.process.on('exit', done));
    this.session = undefined;
    await this.send('Browser.close').catch(() => this.process.kill());
    if (this.process.exitCode === null && this.process.signalCode === null) await gone;
    rmSync(this.home, {recursive: true, force: true, maxRetries: 5});
  }
}
