// The functions of OpenGL ES 3.00 that are used, as the context gives them: nothing of GL is linked to the program, so
// that it starts where there is none. Under WebAssembly they are the browser's.
#pragma once

#include <GLES3/gl3.h>

#include "bihive/base/result.h"

namespace bihive {

/// X(return type, name without "gl", parameters) for each.
#define BIHIVE_GL_FUNCTIONS(X) \
  X(GLenum, GetError, (void))  \
  X(const GLubyte*, GetString, (GLenum))

/// One context's functions. gl.GetError() is glGetError().
struct GlFunctions {
#define BIHIVE_GL_MEMBER(type, name, parameters) type(GL_APIENTRY* name) parameters = nullptr;
  BIHIVE_GL_FUNCTIONS(BIHIVE_GL_MEMBER)
#undef BIHIVE_GL_MEMBER
};

/// Looks every function up by its full name ("glGetError"), as eglGetProcAddress or glfwGetProcAddress does. Error: the
/// context lacks one.
using GlLoader = void (*(*)(const char* name))();
Result<GlFunctions> load_gl_functions(GlLoader loader);

#ifdef __EMSCRIPTEN__
/// The browser's.
GlFunctions browser_gl_functions();
#endif

}  // namespace bihive
