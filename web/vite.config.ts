import { defineConfig } from 'vite';

// The page lies in a folder of any name: all addresses are relative to it. The WebAssembly modules are copied beside it
// as they are (scripts/build_web, which also says where to).
export default defineConfig({
  base: './',
  publicDir: 'public', // what an installed page needs
  build: {
    target: 'es2022',
    modulePreload: { polyfill: false },
    assetsInlineLimit: 0,
    // Languages are loaded on demand; scripts/page_size knows them by their folder.
    rollupOptions: {
      output: {
        chunkFileNames: ({ facadeModuleId }) => `assets/${facadeModuleId?.includes('/languages/') ? 'languages/' : ''}[name]-[hash].js`,
      },
    },
  },
  worker: { format: 'es' },
});
