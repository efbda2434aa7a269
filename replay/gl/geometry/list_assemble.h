/*
 * A finished list, made cheap to call. Calls that set again what the list has just set are dropped. Batches of Begin
 * and End with nothing but vertex attributes between become meshes. A batch stays as calls if a vertex needs an
 * attribute that is known only when the list is called.
 */
#pragma once

struct gls_exec;
struct gls_list;

/** Takes the list. @return what to keep in its place: the same list if memory is short (reported) */
struct gls_list *gls_list_assemble(struct gls_exec *x, struct gls_list *list);

/** The machine in which lists are assembled; NULL is allowed. */
void gls_assembler_free(struct gls_exec *assembler);
