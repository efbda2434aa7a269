/*
 * Varyings that the vertex shader sets to a uniform or a constant, in perspective: white where they have exactly that
 * value. Mesa does not interpolate the first of them. A frame each; recorded by test_small.py.
 */
#include "tests/trace/window.h"

#define IN_MAIN(text) "void main() { gl_Position = ftransform(); " text " }\n"
#define SHOWN(text) "void main() { gl_FragColor = vec4(vec3(equal(" text ", c)), 1.0); }\n"
static const char *const shaders[][2] = {
	/* not interpolated */
	{ IN_MAIN("v = vec4(c, gl_Color.a);"), SHOWN("v.rgb") },
	{ IN_MAIN("v = vec4(0.15, 0.3, 0.95, gl_Color.a); v.b = c.b;"), SHOWN("v.rgb") },
	{ "vec3 pick(vec3 a) { return a.bgr * 1.0 + 0.0; }\n"
	  IN_MAIN("vec3 t = vec3(c.b, c.g, 9.0); t.z = c.r; v = vec4(pick(t), 1.0);"), SHOWN("v.rgb") },
	{ IN_MAIN("v.a = 0.5; v.rgb = c; if (gl_Vertex.x > 0.0) v.a = gl_Color.a;"), SHOWN("v.rgb") },
	{ IN_MAIN("if (gl_Vertex.x > 0.0) v = gl_Color; v = vec4(many[1].rgb, 1.0); if (c.r > 0.9) return;"), SHOWN("v.rgb") },
	{ IN_MAIN("v = vec4(gl_Fog.color.rgb, gl_Fog.density);"), SHOWN("v.rgb") },
	{ IN_MAIN("rows[1] = c; rows[0] = gl_Color.rgb;"), SHOWN("rows[1] + 0.0 * rows[0]") },
	{ IN_MAIN("m = mat3(c, c, gl_Color.rgb);"), SHOWN("m[1]") },
	{ IN_MAIN("v = vec4(c, gl_Color.a);"),
	  SHOWN("vec3(vec3(v.r, c.g, 0.95)[int(mod(gl_FragCoord.x, 3.0))], v.gb)") },
	/* interpolated */
	{ IN_MAIN("v = vec4(c * gl_Color.a, 1.0);"), SHOWN("v.rgb") },
	{ IN_MAIN("v = vec4(c, 1.0); if (gl_Vertex.x > 0.0) v.rg = c.rg + gl_Vertex.xx * 1e-9;"), SHOWN("v.rgb") },
};
enum { N_SHADERS = sizeof(shaders) / sizeof(*shaders) };

static GLuint shader_of(GLenum stage, const char *text)
{
	const char *const texts[] = {
		"uniform vec3 c; uniform vec4 many[2]; varying vec4 v; varying vec3 rows[2]; varying mat3 m;\n", text
	};
	const GLuint shader = glCreateShader(stage);

	glShaderSource(shader, 2, texts, NULL);
	glCompileShader(shader);
	return shader;
}

static void use_program(int i)
{
	static const GLfloat color[] = { 0.15f, 0.3f, 0.95f, 1 }, many[] = { 0.1f, 0.1f, 0.1f, 1, 0.15f, 0.3f, 0.95f, 1 };
	const GLuint program = glCreateProgram();

	glAttachShader(program, shader_of(GL_VERTEX_SHADER, shaders[i][0]));
	glAttachShader(program, shader_of(GL_FRAGMENT_SHADER, shaders[i][1]));
	glLinkProgram(program);
	glUseProgram(program);
	glUniform3fv(glGetUniformLocation(program, "c"), 1, color);
	if (glGetUniformLocation(program, "many") >= 0)
		glUniform4fv(glGetUniformLocation(program, "many"), 2, many);
	glFogfv(GL_FOG_COLOR, color);
}

int main(void)
{
	open_window();
	glClearColor(0.1f, 0.2f, 0.3f, 1);
	for (int i = 0; i < N_SHADERS; i++) {
		begin_view();
		use_program(i);
		glBegin(GL_QUADS);
		glColor4f(0.5f, 0.6f, 0.7f, 1);
		glVertex3f(-20, -1, -1.5f);
		glVertex3f(20, -1, -1.5f);
		glColor4f(0.5f, 0.6f, 0.7f, i < 9 ? 0.8f : 1);
		glVertex3f(50, 40, -80);
		glVertex3f(-50, 40, -80);
		glEnd();
		end_frame();
	}
	return 0;
}
