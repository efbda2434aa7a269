/*
 * A list that is whole, made cheap to call: calls that set again what the list itself has just set are dropped, and runs of Begin and
 * End with nothing but vertex attributes between become meshes. A run stays as calls where a vertex needs an attribute that is
 * only known when the list is called.
 */
#ifndef REPLAY_GL_GEOMETRY_LIST_ASSEMBLE_H
#define REPLAY_GL_GEOMETRY_LIST_ASSEMBLE_H

struct gls_exec;
struct gls_list;

/** @return the list to keep in its place; the same one where memory is short (reported). The one given is no more */
struct gls_list *gls_list_assemble(struct gls_exec *x, struct gls_list *list);

/** The machine in which lists are assembled; NULL is allowed. */
void gls_assembler_free(struct gls_exec *assembler);

#endif
