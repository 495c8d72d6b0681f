// Placed before the JavaScript of em++: newer nodes have a fetch() that cannot read files, and em++ 3.1 would use it
// instead of node's file system.
if (typeof process === 'object') globalThis.fetch = undefined;

// The program sees the environment that node has.
if (typeof process === 'object') Module['preRun'] = [() => Object.assign(ENV, process.env)];
