// Goes before the JavaScript that em++ makes: newer nodes have a fetch() that cannot read files, and em++ 3.1 would use
// it in place of node's file system.
if (typeof process === 'object') globalThis.fetch = undefined;
