/* Shader and program objects of GLSL in a snapshot: saved as source, translated again. */
#pragma once

struct loader;
struct saver;
struct table;

void snapshot_put_shaders(struct saver *s, const struct table *shaders);
void snapshot_get_shaders(struct loader *l, struct table *shaders);
