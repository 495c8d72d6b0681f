// Sets of up to seven spheres, at few places or at any: their measures against arithmetic of 384 bits.
#include "engines.h"
#include "support/measure_differences.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace bihive;
  fuzz::Bytes bytes(data, size);
  constexpr int kMostBalls = 7;
  const int count = 1 + bytes.take<std::uint8_t>() % kMostBalls;
  // Whole numbers of few bits touch and meet; their step may be small beside the radii.
  const bool on_grid = bytes.take<std::uint8_t>() % 4 != 0;
  measure::Balls balls;
  for (int i = 0; i < count; ++i) {
    const auto coordinate = [&]() -> double {
      if (on_grid) return (bytes.take<std::uint8_t>() % 17 - 8) / 16.0;
      const int high = bytes.take<std::uint8_t>(), low = bytes.take<std::uint8_t>();
      return (256 * high + low - 32768) / 65536.0;
    };
    const double x = coordinate(), y = coordinate(), z = coordinate();
    balls.centre.push_back({x, y, z});
    const int radius = bytes.take<std::uint8_t>();
    balls.radius.push_back(on_grid ? (1 + radius % 16) / 16.0 : (1 + radius) / 256.0);
  }
  fuzz::demand(test::measure_differences(balls, true).empty());
  return 0;
}
