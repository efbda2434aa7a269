#include "replay/glsl/text/macro.h"

#include <stdio.h>
#include <string.h>

#include "replay/glsl/text/lexer.h"

#define MAX_EXPANDED (1u << 20) /* maximum number of tokens that macros expand to */

/* Tokens to be read before the text continues. */
struct parse_input {
	struct parse_input *below;
	const struct parse_token *at, *end;
	struct parse_macro *macro; /* the macro they come from, busy until they are read; NULL: none */
	bool stops;                /* nothing below it is read */
};

void parse_tokens_add(struct parse *p, struct parse_tokens *list, const struct parse_token *token)
{
	list->at = parse_grow(p, list->at, list->n, &list->room, sizeof(*list->at));
	list->at[list->n++] = *token;
}

/* --- Definitions -------------------------------------------------------------------------------------------------- */

static bool is_same_token(const struct parse_token *a, const struct parse_token *b)
{
	return a->kind == b->kind && a->n == b->n && memcmp(a->text, b->text, a->n) == 0 && a->spaced == b->spaced;
}

static bool is_same(const struct parse_macro *a, const struct parse_macro *b)
{
	bool same = a->is_function == b->is_function && a->n_parameters == b->n_parameters && a->n_body == b->n_body;

	for (uint32_t i = 0; same && i < a->n_parameters; i++)
		same = a->parameters[i] == b->parameters[i];
	for (uint32_t i = 0; same && i < a->n_body; i++)
		same = is_same_token(&a->body[i], &b->body[i]);
	return same;
}

/* @return number of tokens in the parameter list, including brackets */
static uint32_t read_parameters(struct parse *p, struct parse_macro *macro, const struct parse_token *tokens,
                                uint32_t n)
{
	uint32_t i = 1, room = 0;

	macro->is_function = true;
	while (i < n && !(macro->n_parameters == 0 && parse_is_sign(&tokens[i], ')'))) {
		if (tokens[i].kind != PARSE_NAME || i + 1 == n ||
		    !(parse_is_sign(&tokens[i + 1], ',') || parse_is_sign(&tokens[i + 1], ')')))
			parse_error(p, "a macro's parameters are not a list of names");
		for (uint32_t k = 0; k < macro->n_parameters; k++)
			if (macro->parameters[k] == tokens[i].name)
				parse_error(p, "a macro has two parameters '%s'", tokens[i].name->text);
		macro->parameters = parse_grow(p, macro->parameters, macro->n_parameters, &room,
		                               sizeof(*macro->parameters));
		macro->parameters[macro->n_parameters++] = tokens[i].name;
		i += 2;
		if (parse_is_sign(&tokens[i - 1], ')'))
			return i;
	}
	if (i == n)
		parse_error(p, "a macro's parameters are not closed");
	return i + 1;
}

void parse_macro_define(struct parse *p, const struct parse_token *tokens, uint32_t n)
{
	struct parse_macro *macro = parse_alloc(p, sizeof(*macro));
	struct parse_name *name = tokens[0].name;
	uint32_t begin = 1;

	if (tokens[0].kind != PARSE_NAME || strncmp(name->text, "GL_", 3) == 0 || strcmp(name->text, "defined") == 0)
		parse_error(p, "'%.*s' cannot be a macro", (int)tokens[0].n, tokens[0].text);
	if (n > 1 && parse_is_sign(&tokens[1], '(') && !tokens[1].spaced)
		begin += read_parameters(p, macro, tokens + 1, n - 1);
	macro->n_body = n - begin;
	macro->body = parse_alloc(p, macro->n_body * sizeof(*macro->body));
	for (uint32_t i = 0; i < macro->n_body; i++) {
		macro->body[i] = tokens[begin + i];
		macro->body[i].spaced &= i > 0;
		for (uint32_t k = 0; k < macro->n_parameters; k++)
			if (macro->body[i].kind == PARSE_NAME && macro->body[i].name == macro->parameters[k])
				macro->body[i].parameter = k + 1;
	}
	if (macro->n_body && (parse_is_sign(&macro->body[0], PARSE_SIGN2('#', '#')) ||
	                      parse_is_sign(&macro->body[macro->n_body - 1], PARSE_SIGN2('#', '#'))))
		parse_error(p, "'##' is at an end of a macro");
	if (name->macro && (name->macro->is_line || name->macro->busy || !is_same(name->macro, macro)))
		parse_error(p, "the macro '%s' is already defined differently", name->text);
	name->macro = macro;
}

void parse_macro_set(struct parse *p, const char *name, uint32_t value)
{
	struct parse_macro *macro = parse_alloc(p, sizeof(*macro));
	char *text = parse_alloc(p, 12);

	macro->is_line = strcmp(name, "__LINE__") == 0;
	macro->n_body = 1;
	macro->body = parse_alloc(p, sizeof(*macro->body));
	*macro->body = (struct parse_token){ .kind = PARSE_NUMBER,
		                             .text = text,
		                             .n = (uint32_t)snprintf(text, 12, "%u", value) };
	parse_name(p, name, (uint32_t)strlen(name))->macro = macro;
}

/* --- Expansion ---------------------------------------------------------------------------------------------------- */

static void push(struct parse *p, const struct parse_token *tokens, uint32_t n, struct parse_macro *macro, bool stops)
{
	struct parse_input *input = parse_alloc(p, sizeof(*input));

	*input = (struct parse_input){ p->input, tokens, n ? tokens + n : tokens, macro, stops };
	if (macro)
		macro->busy = true;
	p->input = input;
}

/* Drop inputs that have been read. @return the one to continue from; NULL: the text */
static struct parse_input *input_now(struct parse *p)
{
	while (p->input && p->input->at == p->input->end && !p->input->stops) {
		if (p->input->macro)
			p->input->macro->busy = false;
		p->input = p->input->below;
	}
	return p->input;
}

static void take(struct parse *p, struct parse_token *token)
{
	struct parse_input *input = input_now(p);

	if (!input)
		p->read(p, token);
	else if (input->at == input->end)
		*token = (struct parse_token){ .kind = PARSE_END, .line = p->line };
	else
		*token = *input->at++;
}

static bool is_called(struct parse *p)
{
	struct parse_input *input = input_now(p);
	struct parse_place ahead = p->place;
	struct parse_token token;

	if (input)
		return input->at < input->end && parse_is_sign(input->at, '(');
	parse_lex(p, &ahead, &token);
	return parse_is_sign(&token, '(');
}

/* The arguments of a call, separated by commas. @return [macro->n_parameters] */
static struct parse_tokens *arguments_of(struct parse *p, const struct parse_macro *macro)
{
	struct parse_tokens *list = parse_alloc(p, (macro->n_parameters + 1) * sizeof(*list));
	uint32_t depth = 0, at = 0;
	struct parse_token token;

	take(p, &token);
	for (;;) {
		take(p, &token);
		if (token.kind == PARSE_END)
			parse_error(p, "a macro's arguments are not closed");
		if (parse_is_sign(&token, ')') && !depth--)
			break;
		depth += parse_is_sign(&token, '(');
		if (parse_is_sign(&token, ',') && !depth) {
			if (++at >= macro->n_parameters)
				parse_error(p, "a macro is called with too many arguments");
			continue;
		}
		if (!macro->n_parameters)
			parse_error(p, "a macro without parameters is called with arguments");
		if (++p->n_expanded > MAX_EXPANDED)
			parse_refuse(p, "a shader's macros expand to too much text");
		parse_tokens_add(p, &list[at], &token);
	}
	if (macro->n_parameters && at + 1 < macro->n_parameters)
		parse_error(p, "a macro is called with too few arguments");
	return list;
}

/* Paste two tokens into one. */
static void paste(struct parse *p, struct parse_token *left, const struct parse_token *right)
{
	char *text = parse_alloc(p, left->n + right->n + 1);
	struct parse_place place = { .at = text };
	struct parse_token both;

	memcpy(text, left->text, left->n);
	memcpy(text + left->n, right->text, right->n);
	parse_lex(p, &place, &both);
	if (*place.at || both.kind == PARSE_ODD)
		parse_error(p, "'%s', made by '##', is not a token", text);
	both.spaced = left->spaced;
	both.line = left->line;
	*left = both;
}

static void add_all(struct parse *p, struct parse_tokens *to, const struct parse_tokens *from, bool pasted)
{
	for (uint32_t i = 0; i < from->n; i++) {
		p->n_expanded++;
		if (p->n_expanded > MAX_EXPANDED)
			parse_refuse(p, "a shader's macros expand to too much text");
		if (i == 0 && pasted && to->n)
			paste(p, &to->at[to->n - 1], &from->at[0]);
		else
			parse_tokens_add(p, to, &from->at[i]);
	}
}

static void substitute(struct parse *p, struct parse_macro *macro, uint32_t line)
{
	struct parse_tokens *given = macro->is_function ? arguments_of(p, macro) : NULL, to = { 0 }, whole;
	bool pastes = false;

	for (uint32_t i = 0; i < macro->n_body; i++) {
		struct parse_token token = macro->body[i];
		const bool before = i + 1 < macro->n_body && parse_is_sign(&macro->body[i + 1], PARSE_SIGN2('#', '#'));
		const uint32_t old = to.n;

		if (parse_is_sign(&token, PARSE_SIGN2('#', '#')))
			continue;
		token.line = line;
		whole = (struct parse_tokens){ &token, 1, 1 };
		if (token.parameter)
			whole = given[token.parameter - 1];
		if (token.parameter && !before && !pastes)
			whole = parse_macro_expand(p, whole.at, whole.n);
		token.parameter = 0;
		add_all(p, &to, &whole, pastes);
		pastes = before && (to.n > old || pastes);
	}
	push(p, to.at, to.n, macro, false);
}

void parse_macro_next(struct parse *p, struct parse_token *token)
{
	for (;;) {
		struct parse_macro *macro;

		take(p, token);
		macro = token->kind == PARSE_NAME && !token->painted ? token->name->macro : NULL;
		if (!macro)
			return;
		if (macro->busy) {
			token->painted = true;
			return;
		}
		if (macro->is_line) {
			char *text = parse_alloc(p, 12);

			*token = (struct parse_token){
				.kind = PARSE_NUMBER, .text = text, .line = token->line, .spaced = token->spaced
			};
			token->n = (uint32_t)snprintf(text, 12, "%u", token->line);
			return;
		}
		if (macro->is_function && !is_called(p))
			return;
		substitute(p, macro, token->line);
	}
}

struct parse_tokens parse_macro_expand(struct parse *p, const struct parse_token *tokens, uint32_t n)
{
	struct parse_tokens list = { 0 };
	struct parse_token token;

	parse_enter(p);
	push(p, tokens, n, NULL, true);
	for (parse_macro_next(p, &token); token.kind != PARSE_END; parse_macro_next(p, &token)) {
		if (++p->n_expanded > MAX_EXPANDED)
			parse_refuse(p, "a shader's macros expand to too much text");
		parse_tokens_add(p, &list, &token);
	}
	p->input = p->input->below;
	parse_leave(p);
	return list;
}
