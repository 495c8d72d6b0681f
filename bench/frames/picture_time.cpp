// Prints the times of whole pictures of s1, s2 and s3 as one JSON object. Built natively and as WebAssembly.
//   picture_time [THREADS [REPETITIONS]]
#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <cstdlib>

#include "frames/frame.h"
#include "synthetic.h"

int main(int argc, char** argv) {
  using namespace bihive;
  const int threads = argc > 1 ? std::max(1, std::atoi(argv[1])) : 2;
  const int repetitions = argc > 2 ? std::max(1, std::atoi(argv[2])) : 5;
  const char* separator = "{";
  for (const char* name : {"s1", "s2", "s3"}) {
    const Scene scene = *bench::synthetic_scene(name);
    const Tracer tracer = Tracer::build(scene.spheres, Engine::automatic).value();
    bench::FrameTimes times, warm;
    bench::add_frame(scene, tracer, bench::whole_picture(threads), warm);
    for (int i = 0; i < repetitions; ++i) bench::add_frame(scene, tracer, bench::whole_picture(threads), times);
    std::printf("%s\"%s\": {\"render_ms\": %.4f, \"hash\": \"%016" PRIx64 "\"}", separator, name, times.render_ms(),
                times.hash);
    separator = ", ";
  }
  std::printf("}\n");
  return 0;
}
