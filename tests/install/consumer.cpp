// The smallest program with the library: it counts the atoms of the bundled molecule, and sends a ray through it.
#include <bihive/base/version.h>
#include <bihive/io/bundled.h>
#include <bihive/io/read_spheres.h>
#include <bihive/render/tracer.h>

#include <iostream>

int main() {
  const auto file = bihive::read_spheres_from_memory(bihive::bundled_molecule(), "1hpv.pdb", {});
  if (!file) return 1;
  const auto tracer = bihive::Tracer::build(file->spheres, bihive::Engine::automatic);
  if (!tracer) return 1;
  std::cout << "bihive " << bihive::version() << ": " << file->spheres.size() << " atoms\n";
}
