/*
 * Options, window and frame loop of the corpus programs: an 800x600 double-buffered window by GLUT. Time is the frame
 * number, so every run draws the same pictures.
 *
 *   --frames N              exit after N frames (default: run until closed)
 *   --animate camera|light|none
 *   --step N                show only every N-th frame (default: 1)
 *   --vbo                   take arrays from a buffer object (programs with arrays)
 *   --mirror                add a mirror (programs that have one)
 *   --glass                 add a glass object (programs that have one)
 *   --mesh                  add the model (programs where it is optional)
 *   --model FILE            show an OBJ file (programs with a model; default: a generated knot)
 *   --size WxH              window size (default: 800x600)
 *   --ortho                 parallel projection (programs with a choice)
 *   --by HOW                method of drawing (programs with several)
 */
#pragma once

#define GL_GLEXT_PROTOTYPES
#include <GL/glut.h>
#include <GL/glext.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if __has_include("../capture/relume.h") && !defined(_WIN32)
#include "../capture/relume.h"
#else
enum { RT_MATTE_EXT, RT_MIRROR_EXT, RT_GLASS_EXT };
#define rtMaterialEXT(kind, amount, ior) ((void)(kind), (void)(amount), (void)(ior))
#endif

struct program {
	const char *title;
	void (*draw)(void); /* one frame of `program_frame`, without the swap */
	long frames;        /* 0: unlimited */
	long step;          /* frame numbers from one frame to the next */
	int width, height;  /* size of the window */
	int animate_camera, animate_light, vbo, mirror, glass, mesh, ortho;
	int stencil;        /* set before program_run: 1: the window has a stencil buffer */
	const char *model, *by; /* NULL: not given */
};

static struct program program = { .step = 1, .width = 800, .height = 600 };
#define PROGRAM_WIDTH program.width
#define PROGRAM_HEIGHT program.height
static long program_frame; /* from 0, in multiples of program.step */

static void program_display(void)
{
	program.draw();
	glFlush();
	glutSwapBuffers();
	program_frame += program.step;
	if (program.frames && program_frame >= program.frames * program.step)
		exit(0);
	glutPostRedisplay();
}

static void program_usage(const char *name)
{
	fprintf(stderr, "usage: %s [--frames N] [--step N] [--animate camera|light|none] [--vbo] [--mirror] [--glass] "
	        "[--mesh] [--size WxH] [--ortho] [--model FILE] [--by HOW]\n", name);
	exit(2);
}

static void program_animate(const char *name, const char *what)
{
	program.animate_camera = strcmp(what, "camera") == 0;
	program.animate_light = strcmp(what, "light") == 0;
	if (!program.animate_camera && !program.animate_light && strcmp(what, "none") != 0)
		program_usage(name);
}

static void program_parse(int argc, char **argv)
{
	for (int i = 1; i < argc; i++) {
		if (strcmp(argv[i], "--vbo") == 0)
			program.vbo = 1;
		else if (strcmp(argv[i], "--mirror") == 0)
			program.mirror = 1;
		else if (strcmp(argv[i], "--glass") == 0)
			program.glass = 1;
		else if (strcmp(argv[i], "--mesh") == 0)
			program.mesh = 1;
		else if (strcmp(argv[i], "--ortho") == 0)
			program.ortho = 1;
		else if (i + 1 == argc)
			program_usage(argv[0]);
		else if (strcmp(argv[i], "--frames") == 0 && atol(argv[i + 1]) > 0)
			program.frames = atol(argv[++i]);
		else if (strcmp(argv[i], "--step") == 0 && atol(argv[i + 1]) > 0)
			program.step = atol(argv[++i]);
		else if (strcmp(argv[i], "--size") == 0 && sscanf(argv[i + 1], "%dx%d", &program.width, &program.height) == 2)
			i++;
		else if (strcmp(argv[i], "--animate") == 0)
			program_animate(argv[0], argv[++i]);
		else if (strcmp(argv[i], "--model") == 0)
			program.model = argv[++i];
		else if (strcmp(argv[i], "--by") == 0)
			program.by = argv[++i];
		else
			program_usage(argv[0]);
	}
}

/**
 * Open the window and draw frames until the last one; does not return.
 * @param init  called once with the context current, before the first frame
 */
static void program_run(int argc, char **argv, const char *title, void (*init)(void), void (*draw)(void))
{
	glutInit(&argc, argv);
	program.title = title;
	program.draw = draw;
	program_parse(argc, argv);
	glutInitDisplayMode(GLUT_DOUBLE | GLUT_RGB | GLUT_DEPTH | (program.stencil ? GLUT_STENCIL : 0));
	glutInitWindowSize(PROGRAM_WIDTH, PROGRAM_HEIGHT);
	glutCreateWindow(title);
	init();
	glutDisplayFunc(program_display);
	glutMainLoop();
}

/** Set a perspective projection for the window's shape; the modelview matrix is current afterwards. */
static inline void program_perspective(double fovy_deg, double near, double far)
{
	glMatrixMode(GL_PROJECTION);
	glLoadIdentity();
	gluPerspective(fovy_deg, (double)PROGRAM_WIDTH / PROGRAM_HEIGHT, near, far);
	glMatrixMode(GL_MODELVIEW);
}

/** Set the ambient and diffuse colour of both sides. */
static inline void program_color(float red, float green, float blue)
{
	glMaterialfv(GL_FRONT_AND_BACK, GL_AMBIENT_AND_DIFFUSE, (const float[]){ red, green, blue, 1 });
}

/** Distance moved up to this frame, at a_frame per frame; 0 if not animated. */
static inline float program_moved(int is_animated, float a_frame)
{
	return is_animated ? a_frame * (float)program_frame : 0;
}
