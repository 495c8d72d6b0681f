// The few functions of OpenGL that the window itself calls.
#pragma once

#include <GLES3/gl3.h>

#include "bihive/base/result.h"

namespace bihive::window {

#define BIHIVE_WINDOW_GL_FUNCTIONS(X)                                                               \
  X(void, BindTexture, (GLenum, GLuint))                                                            \
  X(void, Clear, (GLbitfield))                                                                      \
  X(void, ClearColor, (GLfloat, GLfloat, GLfloat, GLfloat))                                         \
  X(void, DeleteTextures, (GLsizei, const GLuint*))                                                 \
  X(void, Finish, ())                                                                               \
  X(void, GenTextures, (GLsizei, GLuint*))                                                          \
  X(const GLubyte*, GetString, (GLenum))                                                            \
  X(void, PixelStorei, (GLenum, GLint))                                                             \
  X(void, ReadPixels, (GLint, GLint, GLsizei, GLsizei, GLenum, GLenum, void*))                      \
  X(void, TexImage2D, (GLenum, GLint, GLint, GLsizei, GLsizei, GLint, GLenum, GLenum, const void*)) \
  X(void, TexParameteri, (GLenum, GLenum, GLint))                                                   \
  X(void, Viewport, (GLint, GLint, GLsizei, GLsizei))

struct Gl {
// NOLINTNEXTLINE(bugprone-macro-parentheses): they are parts of declarations
#define BIHIVE_WINDOW_GL_MEMBER(type, name, parameters) type(GL_APIENTRY* name) parameters = nullptr;
  BIHIVE_WINDOW_GL_FUNCTIONS(BIHIVE_WINDOW_GL_MEMBER)
#undef BIHIVE_WINDOW_GL_MEMBER
};

/// Looks up the functions of the current context. Error: it lacks one.
Result<Gl> load_gl();

}  // namespace bihive::window
