#include "bihive/gl/functions.h"

namespace bihive {

Result<GlFunctions> load_gl_functions(GlLoader loader) {
  GlFunctions functions;
  // NOLINTBEGIN(cppcoreguidelines-pro-type-reinterpret-cast)
#define BIHIVE_GL_LOAD(type, name, parameters)                                     \
  functions.name = reinterpret_cast<decltype(functions.name)>(loader("gl" #name)); \
  if (functions.name == nullptr)                                                   \
    return Error{"OpenGL has no gl" #name, "", 0, 0, "OpenGL ES 3.0 or OpenGL 3.3 is needed"};
  BIHIVE_GL_FUNCTIONS(BIHIVE_GL_LOAD)
#undef BIHIVE_GL_LOAD
  // NOLINTEND(cppcoreguidelines-pro-type-reinterpret-cast)
  return functions;
}

#ifdef __EMSCRIPTEN__
GlFunctions browser_gl_functions() {
  GlFunctions functions;
#define BIHIVE_GL_TAKE(type, name, parameters) functions.name = gl##name;
  BIHIVE_GL_FUNCTIONS(BIHIVE_GL_TAKE)
#undef BIHIVE_GL_TAKE
  return functions;
}
#endif

}  // namespace bihive
