// The smallest program with the library: how many atoms has the bundled molecule, and does a ray through it hit one?
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
