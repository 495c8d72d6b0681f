#include "bihive/kernels/wide_builder.h"

namespace bihive {

struct WideBuilder::State {};
WideBuilder::WideBuilder() : state_(std::make_shared<State>()) {}
WideBuilder::~WideBuilder() = default;

}  // namespace bihive
