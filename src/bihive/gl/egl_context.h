// A context of OpenGL ES 3 without a window, through EGL. Not available under WebAssembly.
#pragma once

#include <memory>
#include <string>

#include "bihive/base/result.h"
#include "bihive/gl/functions.h"

namespace bihive {

/// EGL is loaded only when a context is needed: libEGL.so.1, or the file named by the environment variable BIHIVE_EGL.
/// A graphics processor is preferred to Mesa's software.
class EglContext {
 public:
  /// Makes a context and makes it current in this thread. Error: there is no EGL, or it gives no such context; the hint
  /// says what to install.
  static Result<EglContext> create();
  EglContext(EglContext&& other) noexcept;
  EglContext& operator=(EglContext&& other) noexcept;
  /// All objects of the context must be deleted before.
  ~EglContext();

  const GlFunctions& functions() const;

 private:
  class Implementation;
  explicit EglContext(std::unique_ptr<Implementation> implementation);
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace bihive
