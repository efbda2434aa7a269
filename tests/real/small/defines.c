/*
 * Which extensions the preprocessor of GLSL defines: a bar for each, in a frame for each version; recorded
 * by test_small.py.
 */
#include "tests/trace/window.h"

static const char *const names[] = {
	"GL_ARB_texture_rectangle", "GL_EXT_gpu_shader4", "GL_EXT_texture_array", "GL_OES_standard_derivatives",
	"GL_EXT_shadow_samplers", "GL_EXT_separate_shader_objects", "GL_EXT_shader_integer_mix", "GL_EXT_frag_depth",
};
enum { N_NAMES = sizeof(names) / sizeof(*names) };

static void use_program(const char *version, const char *name)
{
	const GLuint program = glCreateProgram(), shader = glCreateShader(GL_FRAGMENT_SHADER);
	const char *texts[] = { version, "#ifdef ", name,
		                "\nvoid main() { gl_FragColor = vec4(0.0, 1.0, 0.0, 1.0); }\n"
		                "#else\nvoid main() { gl_FragColor = vec4(1.0, 0.0, 0.0, 1.0); }\n#endif\n" };

	glShaderSource(shader, 4, texts, NULL);
	glCompileShader(shader);
	glAttachShader(program, shader);
	glLinkProgram(program);
	glUseProgram(program);
}

int main(void)
{
	static const char *const versions[] = { "", "#version 120\n" };

	open_window();
	for (int v = 0; v < 2; v++) {
		glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
		for (int i = 0; i < N_NAMES; i++) {
			use_program(versions[v], names[i]);
			glRectf(-1 + 2.0f * (float)i / N_NAMES, -0.9f, -1 + (2.0f * (float)i + 1.5f) / N_NAMES, 0.9f);
		}
		end_frame();
	}
	return 0;
}
