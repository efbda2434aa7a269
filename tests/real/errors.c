/*
 * Calls at the limits of what OpenGL accepts, each followed by glGetError; prints "CALL ERROR" lines. Recorded by
 * test_errors.py, where the replay has to report the same errors.
 */
#include "tests/trace/window.h"

#include <string.h>

static const GLubyte bytes[4096];
static const GLfloat numbers[4096], ones[16] = { 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1 };
static const GLdouble doubles[16] = { 1 };

static void print_error(const char *call)
{
	printf("%.*s %x\n", (int)strcspn(call, "("), call, glGetError());
}

#define TRY(call) ((call), print_error(#call))

static void state(void)
{
	TRY(glEnable(GL_TEXTURE_2D));
	TRY(glEnable(GL_FOG_MODE));
	TRY(glDisable(GL_MAP1_VERTEX_4));
	TRY(glEnable(GL_CLIP_PLANE5 + 1));
	TRY(glEnable(GL_CLIP_PLANE0 + 9));
	TRY(glEnable(GL_LIGHT7));
	TRY(glEnable(GL_LIGHT0 + 8));
	TRY(glDisable(GL_LIGHT0));
	TRY(glEnableClientState(GL_NORMAL_ARRAY));
	TRY(glEnableClientState(GL_TEXTURE_2D));
	TRY(glDisableClientState(GL_NORMAL_ARRAY));
	TRY(glAlphaFunc(GL_ALWAYS, 2));
	TRY(glAlphaFunc(GL_BLEND, 0));
	TRY(glDepthFunc(GL_LEQUAL + 16));
	TRY(glDepthFunc(GL_LESS));
	TRY(glDepthRange(2, -3));
	TRY(glDepthRange(0, 1));
	TRY(glStencilFunc(GL_ALWAYS, 300, 255));
	TRY(glStencilFunc(GL_KEEP, 0, 255));
	TRY(glStencilOp(GL_KEEP, GL_REPLACE, GL_INCR_WRAP));
	TRY(glStencilOp(GL_ZERO, GL_ONE, GL_KEEP));
	TRY(glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP));
	TRY(glStencilOpSeparate(GL_FRONT_AND_BACK, GL_KEEP, GL_KEEP, GL_KEEP));
	TRY(glStencilFuncSeparate(GL_FRONT_LEFT, GL_ALWAYS, 0, 255));
	TRY(glStencilMaskSeparate(GL_BACK, 255));
	TRY(glStencilMaskSeparate(GL_ALWAYS, 255));
	TRY(glBlendFunc(GL_SRC_ALPHA_SATURATE, GL_ONE));
	TRY(glBlendFunc(GL_ONE, GL_SRC_ALPHA_SATURATE));
	TRY(glBlendFunc(GL_SRC_COLOR, GL_DST_COLOR));
	TRY(glBlendFunc(GL_CONSTANT_COLOR, GL_ONE_MINUS_CONSTANT_ALPHA));
	TRY(glBlendFunc(GL_ADD, GL_ONE));
	TRY(glBlendFunc(GL_ONE, GL_ZERO));
	TRY(glBlendFuncSeparate(GL_ONE, GL_ZERO, GL_ADD, GL_ONE));
	TRY(glBlendEquation(GL_MIN));
	TRY(glBlendEquation(GL_LOGIC_OP));
	TRY(glBlendEquation(GL_FUNC_ADD));
	TRY(glBlendEquationSeparate(GL_FUNC_ADD, GL_ONE));
	TRY(glLogicOp(GL_COPY));
	TRY(glLogicOp(GL_LOGIC_OP));
	TRY(glCullFace(GL_FRONT_AND_BACK));
	TRY(glCullFace(GL_CW));
	TRY(glCullFace(GL_BACK));
	TRY(glFrontFace(GL_CW));
	TRY(glFrontFace(GL_FRONT));
	TRY(glFrontFace(GL_CCW));
	TRY(glPolygonMode(GL_BACK, GL_LINE));
	TRY(glPolygonMode(GL_FRONT_AND_BACK, GL_TRIANGLES));
	TRY(glPolygonMode(GL_LEFT, GL_FILL));
	TRY(glPolygonMode(GL_FRONT_AND_BACK, GL_FILL));
	TRY(glShadeModel(GL_SMOOTH));
	TRY(glShadeModel(GL_LINEAR));
	TRY(glHint(GL_FOG_HINT, GL_NICEST));
	TRY(glHint(GL_FOG_HINT, GL_FOG));
	TRY(glHint(GL_FOG, GL_NICEST));
	TRY(glHint(GL_GENERATE_MIPMAP_HINT, GL_FASTEST));
	TRY(glPointSize(0));
	TRY(glPointSize(-1));
	TRY(glPointSize(1000));
	TRY(glPointSize(1));
	TRY(glLineWidth(0));
	TRY(glLineWidth(-2));
	TRY(glLineWidth(1));
	TRY(glLineStipple(0, 1));
	TRY(glLineStipple(300, 1));
	TRY(glPointParameterf(GL_POINT_SIZE_MIN, -1));
	TRY(glPointParameterf(GL_POINT_FADE_THRESHOLD_SIZE, 3));
	TRY(glPointParameteri(GL_POINT_SPRITE_COORD_ORIGIN, GL_LOWER_LEFT));
	TRY(glPointParameteri(GL_POINT_SPRITE_COORD_ORIGIN, GL_BACK));
	TRY(glPointParameterf(GL_POINT_SIZE, 1));
	TRY(glScissor(0, 0, -1, 4));
	TRY(glScissor(-5, -5, 64, 64));
	TRY(glViewport(0, 0, -1, 4));
	TRY(glViewport(0, 0, 100000, 48));
	TRY(glViewport(0, 0, 64, 48));
	TRY(glClear(GL_COLOR_BUFFER_BIT | GL_ACCUM_BUFFER_BIT));
	TRY(glClear(0x8000));
	TRY(glDrawBuffer(GL_AUX0));
	TRY(glDrawBuffer(GL_BACK_RIGHT));
	TRY(glDrawBuffer(GL_COLOR));
	TRY(glDrawBuffer(GL_COLOR_ATTACHMENT0));
	TRY(glDrawBuffer(GL_COLOR_ATTACHMENT0 + 31));
	TRY(glDrawBuffer(GL_NONE));
	TRY(glDrawBuffer(GL_BACK));
	TRY(glReadBuffer(GL_RIGHT));
	TRY(glReadBuffer(GL_COLOR));
	TRY(glReadBuffer(GL_COLOR_ATTACHMENT0));
	TRY(glReadBuffer(GL_BACK));
	TRY(glSampleCoverage(7, GL_TRUE));
	TRY(glPushAttrib(GL_ALL_ATTRIB_BITS));
	TRY(glPopAttrib());
	TRY(glPopAttrib());
	TRY(glPopClientAttrib());
	TRY(glProvokingVertex(GL_FIRST_VERTEX_CONVENTION));
	TRY(glProvokingVertex(GL_FRONT));
	TRY(glProvokingVertex(GL_LAST_VERTEX_CONVENTION));
	TRY(glClampColor(GL_CLAMP_READ_COLOR, GL_FALSE));
	TRY(glClampColor(GL_CLAMP_READ_COLOR, GL_FIXED_ONLY));
	TRY(glClampColor(GL_FIXED_ONLY, GL_FALSE));
}

static void transform(void)
{
	TRY(glMatrixMode(GL_DEPTH));
	TRY(glMatrixMode(GL_MODELVIEW));
	TRY(glPopMatrix());
	for (int i = 0; i < 40; i++)
		TRY(glPushMatrix());
	for (int i = 0; i < 40; i++)
		TRY(glPopMatrix());
	TRY(glMatrixMode(GL_TEXTURE));
	for (int i = 0; i < 12; i++)
		TRY(glPushMatrix());
	for (int i = 0; i < 12; i++)
		TRY(glPopMatrix());
	TRY(glMatrixMode(GL_MODELVIEW));
	TRY(glFrustum(-1, 1, -1, 1, 0, 10));
	TRY(glFrustum(-1, -1, -1, 1, 1, 10));
	TRY(glOrtho(0, 0, 0, 1, 0, 1));
	TRY(glOrtho(-1, 1, -1, 1, -1, 1));
	TRY(glClipPlane(GL_CLIP_PLANE0 + 6, doubles));
	TRY(glClipPlane(GL_CLIP_PLANE5, doubles));
	TRY(glClipPlane(GL_CLIP_DISTANCE0 + 8, doubles));
	TRY(glLoadMatrixf(ones));
	TRY(glLoadIdentity());
	TRY(glRotatef(30, 0, 0, 0));
	TRY(glScalef(0, 0, 0));
	TRY(glLoadIdentity());
	TRY(glRasterPos2i(0, 0));
	TRY(glWindowPos2i(-4, 99));
	TRY(glActiveTexture(GL_TEXTURE0 + 500));
	TRY(glActiveTexture(GL_TEXTURE1));
	TRY(glActiveTexture(GL_TEXTURE0));
	TRY(glClientActiveTexture(GL_TEXTURE0 + 500));
	TRY(glClientActiveTexture(GL_TEXTURE7));
	TRY(glClientActiveTexture(GL_TEXTURE0));
}

static void lighting(void)
{
	TRY(glLightf(GL_LIGHT0, GL_SPOT_EXPONENT, 128));
	TRY(glLightf(GL_LIGHT0, GL_SPOT_EXPONENT, 129));
	TRY(glLightf(GL_LIGHT0, GL_SPOT_CUTOFF, 90));
	TRY(glLightf(GL_LIGHT0, GL_SPOT_CUTOFF, 91));
	TRY(glLightf(GL_LIGHT0, GL_SPOT_CUTOFF, 180));
	TRY(glLightf(GL_LIGHT0, GL_LINEAR_ATTENUATION, -1));
	TRY(glLightf(GL_LIGHT0, GL_AMBIENT, 1));
	TRY(glLightf(GL_LIGHT0 + 9, GL_SPOT_EXPONENT, 1));
	TRY(glLightfv(GL_LIGHT0, GL_SHININESS, ones));
	TRY(glLightfv(GL_LIGHT0, GL_POSITION, ones));
	TRY(glLightModelf(GL_LIGHT_MODEL_TWO_SIDE, 1));
	TRY(glLightModeli(GL_LIGHT_MODEL_TWO_SIDE, 0));
	TRY(glLightModelf(GL_LIGHT_MODEL_AMBIENT, 1));
	TRY(glLightModeli(GL_LIGHT_MODEL_COLOR_CONTROL, GL_SEPARATE_SPECULAR_COLOR));
	TRY(glLightModeli(GL_LIGHT_MODEL_COLOR_CONTROL, GL_COLOR));
	TRY(glMaterialf(GL_FRONT, GL_SHININESS, 128));
	TRY(glMaterialf(GL_FRONT, GL_SHININESS, 128.5f));
	TRY(glMaterialf(GL_FRONT, GL_SHININESS, -1));
	TRY(glMaterialf(GL_FRONT, GL_AMBIENT, 1));
	TRY(glMaterialfv(GL_LEFT, GL_AMBIENT, ones));
	TRY(glMaterialfv(GL_FRONT, GL_POSITION, ones));
	TRY(glMaterialfv(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE, ones));
	TRY(glMaterialfv(GL_FRONT, GL_COLOR_INDEXES, ones));
	TRY(glColorMaterial(GL_FRONT, GL_SPECULAR));
	TRY(glColorMaterial(GL_FRONT, GL_SHININESS));
	TRY(glColorMaterial(GL_LEFT, GL_AMBIENT));
	TRY(glFogf(GL_FOG_DENSITY, -1));
	TRY(glFogf(GL_FOG_DENSITY, 2));
	TRY(glFogi(GL_FOG_MODE, GL_EXP));
	TRY(glFogi(GL_FOG_MODE, GL_ADD));
	TRY(glFogf(GL_FOG_COLOR, 1));
	TRY(glFogi(GL_FOG_COORD_SRC, GL_FOG_COORD));
	TRY(glFogi(GL_FOG_COORD_SRC, GL_FOG));
	TRY(glFogi(GL_FOG_COORD_SRC, GL_FRAGMENT_DEPTH));
}

static void textures(void)
{
	GLuint name = 7;

	TRY(glBindTexture(GL_TEXTURE_2D, name));
	TRY(glBindTexture(GL_TEXTURE_3D, name));
	TRY(glBindTexture(GL_TEXTURE, name));
	TRY(glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_LINEAR));
	TRY(glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST_MIPMAP_LINEAR));
	TRY(glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP));
	TRY(glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_MIRROR_CLAMP_EXT));
	TRY(glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_LINEAR));
	TRY(glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, -1));
	TRY(glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, -1));
	TRY(glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, 0));
	TRY(glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 1000));
	TRY(glTexParameterf(GL_TEXTURE_2D, GL_TEXTURE_PRIORITY, 2));
	TRY(glTexParameterf(GL_TEXTURE_2D, GL_TEXTURE_MAX_ANISOTROPY_EXT, 0.5f));
	TRY(glTexParameterf(GL_TEXTURE_2D, GL_TEXTURE_MAX_ANISOTROPY_EXT, 100));
	TRY(glTexParameteri(GL_TEXTURE_2D, GL_DEPTH_TEXTURE_MODE, GL_ALPHA));
	TRY(glTexParameteri(GL_TEXTURE_2D, GL_DEPTH_TEXTURE_MODE, GL_RGBA));
	TRY(glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_R_TO_TEXTURE));
	TRY(glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_LEQUAL));
	TRY(glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_GREATER));
	TRY(glTexParameteri(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, GL_TRUE));
	TRY(glTexParameteri(GL_TEXTURE_2D, GL_GENERATE_MIPMAP, GL_FALSE));
	TRY(glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_LOD_BIAS, 2));
	TRY(glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_BORDER, 1));
	TRY(glTexParameteri(GL_PROXY_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR));
	TRY(glTexParameteri(GL_TEXTURE_RECTANGLE_ARB, GL_TEXTURE_WRAP_S, GL_REPEAT));
	TRY(glTexParameteri(GL_TEXTURE_RECTANGLE_ARB, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR));
	TRY(glTexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, ones));
	TRY(glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 8, 8, 0, GL_RGBA, GL_UNSIGNED_BYTE, bytes));
	TRY(glTexImage2D(GL_TEXTURE_2D, 0, 4, 8, 8, 0, GL_RGB, GL_UNSIGNED_BYTE_3_3_2, bytes));
	TRY(glTexImage2D(GL_TEXTURE_2D, 0, 5, 8, 8, 0, GL_RGB, GL_UNSIGNED_BYTE, bytes));
	TRY(glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 8, 8, 0, GL_RGBA, GL_UNSIGNED_BYTE_3_3_2, bytes));
	TRY(glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 8, 8, 0, GL_RGBA, GL_RGBA, bytes));
	TRY(glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 8, 8, 0, GL_RGBA12, GL_UNSIGNED_BYTE, bytes));
	TRY(glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 7, 5, 0, GL_RGBA, GL_UNSIGNED_BYTE, bytes));
	TRY(glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 10, 6, 1, GL_RGBA, GL_UNSIGNED_BYTE, bytes));
	TRY(glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 8, 8, 2, GL_RGBA, GL_UNSIGNED_BYTE, bytes));
	TRY(glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, -8, 8, 0, GL_RGBA, GL_UNSIGNED_BYTE, bytes));
	TRY(glTexImage2D(GL_TEXTURE_2D, -1, GL_RGBA, 8, 8, 0, GL_RGBA, GL_UNSIGNED_BYTE, bytes));
	TRY(glTexImage2D(GL_TEXTURE_2D, 30, GL_RGBA, 8, 8, 0, GL_RGBA, GL_UNSIGNED_BYTE, bytes));
	TRY(glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 1 << 20, 8, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL));
	TRY(glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, 8, 8, 0, GL_RGBA, GL_UNSIGNED_BYTE, bytes));
	TRY(glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 8, 8, 0, GL_DEPTH_COMPONENT, GL_UNSIGNED_BYTE, bytes));
	TRY(glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT, 8, 8, 0, GL_DEPTH_COMPONENT, GL_UNSIGNED_SHORT, bytes));
	TRY(glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 8, 8, 0, GL_COLOR_INDEX, GL_UNSIGNED_BYTE, bytes));
	TRY(glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 8, 8, 0, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, bytes));
	TRY(glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 8, 8, 0, GL_RGBA, GL_BITMAP, bytes));
	TRY(glTexImage2D(GL_TEXTURE_3D, 0, GL_RGBA, 8, 8, 0, GL_RGBA, GL_UNSIGNED_BYTE, bytes));
	TRY(glTexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X, 0, GL_RGBA, 8, 4, 0, GL_RGBA, GL_UNSIGNED_BYTE, bytes));
	TRY(glTexImage2D(GL_TEXTURE_CUBE_MAP, 0, GL_RGBA, 8, 8, 0, GL_RGBA, GL_UNSIGNED_BYTE, bytes));
	TRY(glTexImage2D(GL_PROXY_TEXTURE_2D, 0, GL_RGBA, 1 << 20, 8, 0, GL_RGBA, GL_UNSIGNED_BYTE, NULL));
	TRY(glTexImage2D(GL_TEXTURE_RECTANGLE_ARB, 1, GL_RGBA, 8, 8, 0, GL_RGBA, GL_UNSIGNED_BYTE, bytes));
	TRY(glTexImage2D(GL_TEXTURE_RECTANGLE_ARB, 0, GL_RGBA, 8, 8, 1, GL_RGBA, GL_UNSIGNED_BYTE, bytes));
	TRY(glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 8, 8, 0, GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV, bytes));
	TRY(glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 8, 8, 0, GL_BGR, GL_UNSIGNED_SHORT_5_6_5, bytes));
	TRY(glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 8, 8, 0, GL_ABGR_EXT, GL_UNSIGNED_BYTE, bytes));
	TRY(glTexImage1D(GL_TEXTURE_1D, 0, GL_LUMINANCE, 8, 0, GL_LUMINANCE, GL_FLOAT, numbers));
	TRY(glTexImage1D(GL_TEXTURE_2D, 0, GL_LUMINANCE, 8, 0, GL_LUMINANCE, GL_FLOAT, numbers));
	TRY(glTexImage1D(GL_TEXTURE_1D, 0, GL_LUMINANCE, 8, 0, GL_RED + 99, GL_FLOAT, numbers));
	TRY(glTexImage3D(GL_TEXTURE_3D, 0, GL_RGBA, 4, 4, 4, 0, GL_RGBA, GL_UNSIGNED_BYTE, bytes));
	TRY(glTexImage3D(GL_TEXTURE_3D, 0, GL_DEPTH_COMPONENT, 4, 4, 4, 0, GL_DEPTH_COMPONENT, GL_UNSIGNED_BYTE, bytes));
	TRY(glTexImage3D(GL_TEXTURE_2D, 0, GL_RGBA, 4, 4, 4, 0, GL_RGBA, GL_UNSIGNED_BYTE, bytes));
	TRY(glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 8, 8, GL_RGBA, GL_UNSIGNED_BYTE, bytes));
	TRY(glTexSubImage2D(GL_TEXTURE_2D, 0, 1, 0, 8, 8, GL_RGBA, GL_UNSIGNED_BYTE, bytes));
	TRY(glTexSubImage2D(GL_TEXTURE_2D, 0, -1, 0, 4, 4, GL_RGBA, GL_UNSIGNED_BYTE, bytes));
	TRY(glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 0, 8, GL_RGBA, GL_UNSIGNED_BYTE, bytes));
	TRY(glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, -1, 8, GL_RGBA, GL_UNSIGNED_BYTE, bytes));
	TRY(glTexSubImage2D(GL_TEXTURE_2D, 5, 0, 0, 4, 4, GL_RGBA, GL_UNSIGNED_BYTE, bytes));
	TRY(glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 4, 4, GL_DEPTH_COMPONENT, GL_UNSIGNED_BYTE, bytes));
	TRY(glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 4, 4, GL_RGBA, GL_DOUBLE, bytes));
	TRY(glTexSubImage1D(GL_TEXTURE_1D, 0, 7, 2, GL_LUMINANCE, GL_FLOAT, numbers));
	TRY(glTexSubImage3D(GL_TEXTURE_3D, 0, 0, 0, 3, 4, 4, 2, GL_RGBA, GL_UNSIGNED_BYTE, bytes));
	TRY(glCopyTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 0, 0, 8, 8, 0));
	TRY(glCopyTexImage2D(GL_TEXTURE_2D, 0, 3, 0, 0, 8, 8, 0));
	TRY(glCopyTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, 0, 0, 8, -8, 0));
	TRY(glCopyTexImage2D(GL_TEXTURE_3D, 0, GL_RGB, 0, 0, 8, 8, 0));
	TRY(glCopyTexSubImage2D(GL_TEXTURE_2D, 0, 4, 4, 0, 0, 4, 4));
	TRY(glCopyTexSubImage2D(GL_TEXTURE_2D, 0, 5, 4, 0, 0, 4, 4));
	TRY(glCopyTexSubImage2D(GL_TEXTURE_2D, 3, 0, 0, 0, 0, 4, 4));
	TRY(glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_COMBINE));
	TRY(glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, 0x8062));
	TRY(glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_LINEAR));
	TRY(glTexEnvi(GL_TEXTURE_ENV, GL_COMBINE_RGB, GL_DOT3_RGBA));
	TRY(glTexEnvi(GL_TEXTURE_ENV, GL_COMBINE_ALPHA, GL_DOT3_RGBA));
	TRY(glTexEnvi(GL_TEXTURE_ENV, GL_COMBINE_ALPHA, GL_ADD_SIGNED));
	TRY(glTexEnvi(GL_TEXTURE_ENV, GL_SRC0_RGB, GL_TEXTURE3));
	TRY(glTexEnvi(GL_TEXTURE_ENV, GL_SRC0_RGB, GL_TEXTURE0 + 30));
	TRY(glTexEnvi(GL_TEXTURE_ENV, GL_SRC0_RGB, GL_ZERO));
	TRY(glTexEnvi(GL_TEXTURE_ENV, GL_SRC0_RGB, GL_MODULATE));
	TRY(glTexEnvi(GL_TEXTURE_ENV, GL_OPERAND0_ALPHA, GL_SRC_COLOR));
	TRY(glTexEnvi(GL_TEXTURE_ENV, GL_OPERAND0_RGB, GL_ONE_MINUS_SRC_COLOR));
	TRY(glTexEnvf(GL_TEXTURE_ENV, GL_RGB_SCALE, 2));
	TRY(glTexEnvf(GL_TEXTURE_ENV, GL_RGB_SCALE, 3));
	TRY(glTexEnvf(GL_TEXTURE_ENV, GL_ALPHA_SCALE, 0));
	TRY(glTexEnvf(GL_TEXTURE_FILTER_CONTROL, GL_TEXTURE_LOD_BIAS, 9));
	TRY(glTexEnvi(GL_POINT_SPRITE, GL_COORD_REPLACE, 1));
	TRY(glTexEnvi(GL_POINT_SPRITE, GL_COORD_REPLACE, 2));
	TRY(glTexEnvi(GL_TEXTURE_2D, GL_TEXTURE_ENV_MODE, GL_ADD));
	TRY(glTexEnvf(GL_TEXTURE_ENV, GL_TEXTURE_ENV_COLOR, 1));
	TRY(glTexGeni(GL_S, GL_TEXTURE_GEN_MODE, GL_SPHERE_MAP));
	TRY(glTexGeni(GL_R, GL_TEXTURE_GEN_MODE, GL_SPHERE_MAP));
	TRY(glTexGeni(GL_Q, GL_TEXTURE_GEN_MODE, GL_NORMAL_MAP));
	TRY(glTexGeni(GL_R, GL_TEXTURE_GEN_MODE, GL_NORMAL_MAP));
	TRY(glTexGeni(GL_T, GL_TEXTURE_GEN_MODE, GL_LINEAR));
	TRY(glTexGeni(GL_TEXTURE, GL_TEXTURE_GEN_MODE, GL_EYE_LINEAR));
	TRY(glTexGenf(GL_S, GL_EYE_PLANE, 1));
	TRY(glGenerateMipmap(GL_TEXTURE_2D));
	TRY(glGenerateMipmap(GL_TEXTURE_RECTANGLE_ARB));
	TRY(glCompressedTexImage2D(GL_TEXTURE_2D, 0, GL_COMPRESSED_RGBA_S3TC_DXT5_EXT, 8, 8, 0, 64, bytes));
	TRY(glCompressedTexImage2D(GL_TEXTURE_2D, 0, GL_COMPRESSED_RGBA_S3TC_DXT5_EXT, 8, 8, 0, 63, bytes));
	TRY(glCompressedTexImage2D(GL_TEXTURE_2D, 0, GL_COMPRESSED_RGBA_S3TC_DXT5_EXT, 8, 8, 1, 64, bytes));
	TRY(glCompressedTexImage2D(GL_TEXTURE_2D, 0, GL_COMPRESSED_RGBA, 8, 8, 0, 64, bytes));
	TRY(glCompressedTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 4, 4, GL_COMPRESSED_RGBA_S3TC_DXT5_EXT, 16, bytes));
	TRY(glCompressedTexSubImage2D(GL_TEXTURE_2D, 0, 2, 0, 4, 4, GL_COMPRESSED_RGBA_S3TC_DXT5_EXT, 16, bytes));
	TRY(glCompressedTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 4, 4, GL_COMPRESSED_RGBA_S3TC_DXT3_EXT, 16, bytes));
	TRY(glTexSubImage2D(GL_TEXTURE_2D, 0, 1, 1, 2, 2, GL_RGBA, GL_UNSIGNED_BYTE, bytes));
}

static void pixels(void)
{
	TRY(glPixelStorei(GL_UNPACK_ALIGNMENT, 3));
	TRY(glPixelStorei(GL_UNPACK_ROW_LENGTH, -1));
	TRY(glPixelStorei(GL_UNPACK_SKIP_PIXELS, 2));
	TRY(glPixelStorei(GL_UNPACK_SKIP_PIXELS, 0));
	TRY(glPixelStorei(GL_UNPACK_ALIGNMENT + 1, 1));
	TRY(glPixelTransferf(GL_RED_SCALE, 3));
	TRY(glPixelTransferf(GL_RED_SCALE, 1));
	TRY(glPixelTransferf(GL_RED, 3));
	TRY(glPixelMapfv(GL_PIXEL_MAP_R_TO_R, 0, numbers));
	TRY(glPixelMapfv(GL_PIXEL_MAP_I_TO_R, 3, numbers));
	TRY(glPixelMapfv(GL_PIXEL_MAP_R_TO_R, 3, numbers));
	TRY(glPixelMapfv(GL_PIXEL_MAP_S_TO_S, 4, numbers));
	TRY(glPixelMapfv(GL_RED, 4, numbers));
	TRY(glPixelMapfv(GL_PIXEL_MAP_R_TO_R, 100000, numbers));
	TRY(glPixelZoom(0, -3));
	TRY(glPixelZoom(1, 1));
	TRY(glDrawPixels(4, 4, GL_RGBA, GL_UNSIGNED_BYTE, bytes));
	TRY(glDrawPixels(-4, 4, GL_RGBA, GL_UNSIGNED_BYTE, bytes));
	TRY(glDrawPixels(4, 4, GL_RGBA, GL_BITMAP, bytes));
	TRY(glDrawPixels(4, 4, GL_RGBA, GL_UNSIGNED_SHORT_5_6_5, bytes));
	TRY(glDrawPixels(4, 4, GL_STENCIL_INDEX, GL_BITMAP, bytes));
	TRY(glDrawPixels(4, 4, GL_DEPTH_COMPONENT, GL_FLOAT, numbers));
	TRY(glDrawPixels(4, 4, GL_DEPTH_STENCIL, GL_UNSIGNED_INT_24_8, numbers));
	TRY(glDrawPixels(4, 4, GL_DEPTH_STENCIL, GL_UNSIGNED_INT, numbers));
	TRY(glDrawPixels(4, 4, GL_COLOR, GL_UNSIGNED_BYTE, bytes));
	TRY(glDrawPixels(4, 4, GL_RGBA, GL_DOUBLE, bytes));
	TRY(glDrawPixels(4, 4, GL_COLOR_INDEX, GL_UNSIGNED_BYTE, bytes));
	TRY(glDrawPixels(4, 4, GL_INTENSITY, GL_UNSIGNED_BYTE, bytes));
	TRY(glBitmap(-1, 4, 0, 0, 0, 0, bytes));
	TRY(glBitmap(8, 8, 0, 0, 9, 9, bytes));
	TRY(glCopyPixels(0, 0, 4, 4, GL_COLOR));
	TRY(glCopyPixels(0, 0, -4, 4, GL_COLOR));
	TRY(glCopyPixels(0, 0, 4, 4, GL_RGBA));
	TRY(glCopyPixels(0, 0, 4, 4, GL_DEPTH_STENCIL));
	TRY(glAccum(GL_REPLACE, 1));
}

static void shapes(void)
{
	TRY(glBegin(GL_POLYGON + 90));
	TRY(glEnd());
	glBegin(GL_TRIANGLES);
	glLineWidth(3);
	glEnd();
	print_error("glLineWidth");
	glBegin(GL_TRIANGLES);
	glBegin(GL_POINTS);
	glEnd();
	print_error("glBegin");
	TRY(glRectf(0, 0, 1, 1));
	glVertexPointer(3, GL_FLOAT, 0, numbers);
	glEnableClientState(GL_VERTEX_ARRAY);
	TRY(glDrawArrays(GL_TRIANGLES, 0, -1));
	TRY(glDrawArrays(GL_TRIANGLES, 0, 0));
	TRY(glDrawArrays(GL_TRIANGLES, 0, 3));
	TRY(glDrawArrays(GL_POLYGON + 90, 0, 3));
	TRY(glDrawElements(GL_TRIANGLES, 3, GL_UNSIGNED_BYTE, bytes));
	TRY(glDrawElements(GL_TRIANGLES, 3, GL_BYTE, bytes));
	TRY(glDrawElements(GL_TRIANGLES, -3, GL_UNSIGNED_BYTE, bytes));
	TRY(glDrawRangeElements(GL_TRIANGLES, 0, 2, 3, GL_UNSIGNED_BYTE, bytes));
	TRY(glNewList(0, GL_COMPILE));
	TRY(glNewList(3, GL_RENDER));
	TRY(glEndList());
	TRY(glNewList(3, GL_COMPILE));
	TRY(glNewList(4, GL_COMPILE));
	TRY(glFogf(GL_FOG_DENSITY, -1));
	TRY(glEndList());
	glCallList(3);
	print_error("glFogf");
	TRY(glCallList(99));
	TRY(glCallLists(1, GL_DOUBLE, bytes));
	TRY(glCallLists(-1, GL_BYTE, bytes));
	TRY(glCallLists(2, GL_4_BYTES, bytes));
	TRY(glDeleteLists(3, -1));
	TRY(glGenLists(0));
	TRY(glMap1f(GL_MAP1_VERTEX_3, 0, 0, 3, 4, numbers));
	TRY(glMap1f(GL_MAP1_VERTEX_3, 0, 1, 2, 4, numbers));
	TRY(glMap1f(GL_MAP1_VERTEX_3, 0, 1, 3, 0, numbers));
	TRY(glMap1f(GL_MAP1_VERTEX_3, 0, 1, 3, 31, numbers));
	TRY(glMap1f(GL_MAP2_VERTEX_3, 0, 1, 3, 4, numbers));
	TRY(glMap1f(GL_MAP1_VERTEX_3, 0, 1, 3, 4, numbers));
	TRY(glMap2f(GL_MAP2_VERTEX_3, 0, 1, 3, 4, 0, 1, 12, 40, numbers));
	TRY(glMapGrid1f(0, 0, 1));
	TRY(glMapGrid2f(3, 0, 1, 0, 0, 1));
	TRY(glMapGrid1f(4, 1, 1));
	TRY(glEvalMesh1(GL_FILL, 0, 2));
	TRY(glEvalMesh1(GL_LINE, 0, 2));
	TRY(glEvalMesh2(GL_TRIANGLES, 0, 2, 0, 2));
	TRY(glPushName(1));
	TRY(glPopName());
	TRY(glLoadName(3));
	TRY(glRenderMode(GL_SELECT + 99));
	TRY(glMultiTexCoord2f(GL_TEXTURE0 + 500, 1, 1));
	TRY(glVertexAttrib4f(99, 1, 1, 1, 1));
	TRY(glEdgeFlag(7));
}

static void objects(void)
{
	GLuint buffer = 5, program = glCreateProgram(), shader = glCreateShader(GL_VERTEX_SHADER), framebuffer;

	TRY(glBufferData(GL_ARRAY_BUFFER, 16, bytes, GL_STATIC_DRAW));
	TRY(glBindBuffer(GL_ARRAY_BUFFER, buffer));
	TRY(glBufferData(GL_ARRAY_BUFFER, -16, bytes, GL_STATIC_DRAW));
	TRY(glBufferData(GL_ARRAY_BUFFER, 16, bytes, GL_READ_ONLY));
	TRY(glBufferData(GL_ARRAY_BUFFER, 16, bytes, GL_STATIC_DRAW));
	TRY(glBufferSubData(GL_ARRAY_BUFFER, 8, 9, bytes));
	TRY(glBufferSubData(GL_ARRAY_BUFFER, -1, 2, bytes));
	TRY(glBufferSubData(GL_ARRAY_BUFFER, 8, 8, bytes));
	TRY(glMapBuffer(GL_ARRAY_BUFFER, GL_WRITE_ONLY));
	TRY(glUnmapBuffer(GL_ARRAY_BUFFER));
	TRY(glDeleteBuffers(1, &buffer));
	TRY(glUseProgram(program));
	TRY(glUseProgram(program + 99));
	TRY(glUseProgram(0));
	TRY(glAttachShader(program, shader));
	TRY(glAttachShader(program, shader));
	TRY(glDeleteShader(0));
	TRY(glBindAttribLocation(program, 0, "a"));
	TRY(glBindProgramARB(GL_TEXTURE_2D, 1));
	TRY(glProgramEnvParameter4fvARB(GL_VERTEX_PROGRAM_ARB, 100000, ones));
	TRY(glProgramLocalParameter4fvARB(GL_VERTEX_PROGRAM_ARB, 0, ones));
	glGenFramebuffers(1, &framebuffer);
	TRY(glBindFramebuffer(GL_TEXTURE_2D, framebuffer));
	TRY(glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, 7, 0));
	TRY(glBindFramebuffer(GL_FRAMEBUFFER, framebuffer));
	TRY(glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, 999, 0));
	TRY(glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_3D, 7, 0));
	TRY(glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0 + 30, GL_TEXTURE_2D, 7, 0));
	TRY(glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, 7, -1));
	TRY(glReadBuffer(GL_BACK));
	TRY(glDrawBuffer(GL_BACK));
	TRY(glDrawBuffer(GL_COLOR_ATTACHMENT1));
	TRY(glBindRenderbuffer(GL_FRAMEBUFFER, 1));
	TRY(glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA, 4, 4));
	TRY(glBindFramebuffer(GL_FRAMEBUFFER, 0));
	TRY(glBlitFramebuffer(0, 0, 4, 4, 0, 0, 4, 4, GL_ACCUM_BUFFER_BIT, GL_NEAREST));
	TRY(glBlitFramebuffer(0, 0, 4, 4, 0, 0, 4, 4, GL_DEPTH_BUFFER_BIT, GL_LINEAR));
	TRY(glBlitFramebuffer(0, 0, 4, 4, 0, 0, 4, 4, GL_COLOR_BUFFER_BIT, GL_FOG));
}

int main(void)
{
	open_window();
	glGetError();
	state();
	transform();
	lighting();
	textures();
	pixels();
	shapes();
	objects();
	end_frame();
	return 0;
}
