/*
 * Makes a complete list cheap to call. Calls that repeat what the list has just set are dropped. Batches of Begin and
 * End with only vertex attributes in between become meshes. A batch stays as calls if a vertex needs an attribute that
 * is known only when the list is called.
 */
#pragma once

struct gls_exec;
struct gls_list;

/** Assemble a list; takes ownership. @return the list to use instead: the same one if memory ran out (reported) */
struct gls_list *gls_list_assemble(struct gls_exec *x, struct gls_list *list);

/** Free the machine that assembles lists; NULL is allowed. */
void gls_assembler_free(struct gls_exec *assembler);
