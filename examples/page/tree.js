/* The decision tree: tree.txt becomes nested details; its first comment lines say what the marks mean. */

function parseTree(lines) {
  const root = {branches: [], leaves: []}, open = [root];
  for (const line of lines) {
    const [, mark, rest] = line.match(/^(\*+|[-|>#]) ?(.*)$/) || [];
    if (!mark || mark === '#') continue;
    const here = open[open.length - 1], leaf = here.leaves[here.leaves.length - 1];
    if (mark === '-') here.leaves.push({name: rest, calls: [], show: null});
    else if (mark === '|') leaf.calls.push(rest);
    else if (mark === '>') leaf.show = Object.fromEntries(rest.split(' ').map(pair => {
      const [key, value] = pair.split('=');
      return [key, Number(value)];
    }));
    else {
      open.length = mark.length;
      const branch = {name: rest, branches: [], leaves: []};
      open[open.length - 1].branches.push(branch);
      open.push(branch);
    }
  }
  return root;
}

function element(name, words, ...children) {
  const e = document.createElement(name);
  if (words) e.textContent = words;
  e.append(...children);
  return e;
}

/* show(settings): what a leaf's button does */
function leafElement(leaf, show) {
  const title = element('p', leaf.name), code = element('code', leaf.calls.join('\n'));
  const e = element('div', '', title, code);
  e.className = 'leaf';
  code.tabIndex = 0;
  if (leaf.show) {
    const button = element('button', 'Show above');
    button.type = 'button';
    button.onclick = () => show(leaf.show);
    title.append(button);
  }
  return e;
}

function branchElement(branch, show) {
  return element('details', '', element('summary', branch.name),
    ...branch.leaves.map(leaf => leafElement(leaf, show)),
    ...branch.branches.map(inner => branchElement(inner, show)));
}
