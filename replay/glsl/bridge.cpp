#include "replay/glsl/tree.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <glslang/Include/ResourceLimits.h>
#include <glslang/MachineIndependent/localintermediate.h>
#include <glslang/Public/ShaderLang.h>

extern "C" {
#include "base/err.h"
}

namespace {

using namespace glslang;

/* Deep enough for any shader that people write; the stack holds it. */
constexpr int MAX_DEPTH = 400;
constexpr size_t MAX_NODES = 200000, MAX_NUMBERS = 65536;
constexpr size_t MOST_STATEMENTS = 64; /* between a product and its use: texts can be long */

/* What a shader that is refused says. */
struct refused {
	const char *why;
};

const std::map<TOperator, glsl_operator> OPERATORS = {
	{ EOpSequence, GLSL_SEQUENCE }, { EOpScope, GLSL_SEQUENCE }, { EOpComma, GLSL_COMMA }, { EOpNegative, GLSL_NEGATE },
	{ EOpLogicalNot, GLSL_NOT }, { EOpVectorLogicalNot, GLSL_NOT }, { EOpPostIncrement, GLSL_POST_INCREMENT },
	{ EOpPostDecrement, GLSL_POST_DECREMENT }, { EOpPreIncrement, GLSL_PRE_INCREMENT }, { EOpPreDecrement, GLSL_PRE_DECREMENT },
	{ EOpAdd, GLSL_ADD }, { EOpSub, GLSL_SUBTRACT }, { EOpMul, GLSL_MULTIPLY }, { EOpVectorTimesScalar, GLSL_MULTIPLY },
	{ EOpMatrixTimesScalar, GLSL_MULTIPLY }, { EOpDiv, GLSL_DIVIDE }, { EOpMod, GLSL_MODULO },
	{ EOpMatrixTimesVector, GLSL_MATRIX_TIMES_VECTOR }, { EOpVectorTimesMatrix, GLSL_VECTOR_TIMES_MATRIX },
	{ EOpMatrixTimesMatrix, GLSL_MATRIX_TIMES_MATRIX }, { EOpEqual, GLSL_EQUAL }, { EOpNotEqual, GLSL_NOT_EQUAL },
	{ EOpVectorEqual, GLSL_VECTOR_EQUAL }, { EOpVectorNotEqual, GLSL_VECTOR_NOT_EQUAL }, { EOpLessThan, GLSL_LESS },
	{ EOpGreaterThan, GLSL_GREATER }, { EOpLessThanEqual, GLSL_LESS_EQUAL }, { EOpGreaterThanEqual, GLSL_GREATER_EQUAL },
	{ EOpLogicalOr, GLSL_OR }, { EOpLogicalXor, GLSL_XOR }, { EOpLogicalAnd, GLSL_AND }, { EOpRadians, GLSL_RADIANS },
	{ EOpDegrees, GLSL_DEGREES }, { EOpSin, GLSL_SIN }, { EOpCos, GLSL_COS }, { EOpTan, GLSL_TAN }, { EOpAsin, GLSL_ASIN },
	{ EOpAcos, GLSL_ACOS }, { EOpAtan, GLSL_ATAN }, { EOpSinh, GLSL_SINH }, { EOpCosh, GLSL_COSH }, { EOpTanh, GLSL_TANH },
	{ EOpAsinh, GLSL_ASINH }, { EOpAcosh, GLSL_ACOSH }, { EOpAtanh, GLSL_ATANH }, { EOpPow, GLSL_POW }, { EOpExp, GLSL_EXP },
	{ EOpLog, GLSL_LOG }, { EOpExp2, GLSL_EXP2 }, { EOpLog2, GLSL_LOG2 }, { EOpSqrt, GLSL_SQRT }, { EOpInverseSqrt, GLSL_INVERSE_SQRT },
	{ EOpAbs, GLSL_ABS }, { EOpSign, GLSL_SIGN }, { EOpFloor, GLSL_FLOOR }, { EOpTrunc, GLSL_TRUNC }, { EOpRound, GLSL_ROUND },
	{ EOpRoundEven, GLSL_ROUND_EVEN }, { EOpCeil, GLSL_CEIL }, { EOpFract, GLSL_FRACT }, { EOpMin, GLSL_MIN }, { EOpMax, GLSL_MAX },
	{ EOpClamp, GLSL_CLAMP }, { EOpMix, GLSL_MIX }, { EOpStep, GLSL_STEP }, { EOpSmoothStep, GLSL_SMOOTH_STEP }, { EOpIsNan, GLSL_IS_NAN },
	{ EOpIsInf, GLSL_IS_INF }, { EOpLength, GLSL_LENGTH }, { EOpDistance, GLSL_DISTANCE }, { EOpDot, GLSL_DOT }, { EOpCross, GLSL_CROSS },
	{ EOpNormalize, GLSL_NORMALIZE }, { EOpFaceForward, GLSL_FACE_FORWARD }, { EOpReflect, GLSL_REFLECT }, { EOpRefract, GLSL_REFRACT },
	{ EOpDPdx, GLSL_DPDX }, { EOpDPdy, GLSL_DPDY }, { EOpFwidth, GLSL_FWIDTH }, { EOpOuterProduct, GLSL_OUTER_PRODUCT },
	{ EOpDeterminant, GLSL_DETERMINANT }, { EOpMatrixInverse, GLSL_INVERSE }, { EOpTranspose, GLSL_TRANSPOSE },
	{ EOpFtransform, GLSL_FTRANSFORM }, { EOpNoise, GLSL_NOISE }, { EOpAny, GLSL_ANY }, { EOpAll, GLSL_ALL }, { EOpTexture, GLSL_TEXTURE },
	{ EOpTextureProj, GLSL_TEXTURE_PROJ }, { EOpTextureLod, GLSL_TEXTURE_LOD }, { EOpTextureProjLod, GLSL_TEXTURE_PROJ_LOD },
	{ EOpKill, GLSL_DISCARD }, { EOpReturn, GLSL_RETURN }, { EOpBreak, GLSL_BREAK }, { EOpContinue, GLSL_CONTINUE }, { EOpCase, GLSL_CASE },
	{ EOpDefault, GLSL_DEFAULT },
};

/* What is assigned, by the assigning operator. */
const std::map<TOperator, glsl_operator> ASSIGNED = {
	{ EOpAssign, GLSL_ASSIGN }, { EOpAddAssign, GLSL_ADD }, { EOpSubAssign, GLSL_SUBTRACT }, { EOpMulAssign, GLSL_MULTIPLY },
	{ EOpVectorTimesMatrixAssign, GLSL_VECTOR_TIMES_MATRIX }, { EOpVectorTimesScalarAssign, GLSL_MULTIPLY },
	{ EOpMatrixTimesScalarAssign, GLSL_MULTIPLY }, { EOpMatrixTimesMatrixAssign, GLSL_MATRIX_TIMES_MATRIX }, { EOpDivAssign, GLSL_DIVIDE },
	{ EOpModAssign, GLSL_MODULO },
};

/* --- Products of matrices that variables hold ---------------------------------------------------------------------------- */

using Products = std::map<long long, TIntermTyped *>; /* by the variable's number */

TIntermBinary *as_product(TIntermNode *node)
{
	TIntermBinary *b = node ? node->getAsBinaryNode() : nullptr;

	return b && b->getOp() == EOpMatrixTimesMatrix ? b : nullptr;
}

/* How often each symbol is named, and what else a part of a text does. */
struct Survey : TIntermTraverser {
	std::map<long long, unsigned> named;
	std::vector<long long> written, factors; /* what stands left of an assignment; matrices in products, and before vectors */
	bool is_straight = true; /* it neither branches nor calls */

	void visitSymbol(TIntermSymbol *s) override { named[s->getId()]++; }
	bool visitBinary(TVisit, TIntermBinary *b) override
	{
		TIntermTyped *left = b->getLeft();

		for (TIntermTyped *factor : { left, b->getRight() })
			if ((b->getOp() == EOpMatrixTimesMatrix || (b->getOp() == EOpMatrixTimesVector && factor == left)) && factor->getAsSymbolNode())
				factors.push_back(factor->getAsSymbolNode()->getId());
		while (b->modifiesState() && left->getAsBinaryNode())
			left = left->getAsBinaryNode()->getLeft();
		if (b->modifiesState() && left->getAsSymbolNode())
			written.push_back(left->getAsSymbolNode()->getId());
		return true;
	}
	bool bends(bool here)
	{
		is_straight = is_straight && !here;
		return true;
	}
	bool visitUnary(TVisit, TIntermUnary *u) override { return bends(u->modifiesState()); }
	bool visitAggregate(TVisit, TIntermAggregate *a) override { return bends(a->getOp() == EOpFunctionCall); }
	bool visitSelection(TVisit, TIntermSelection *) override { return bends(true); }
	bool visitLoop(TVisit, TIntermLoop *) override { return bends(true); }
	bool visitSwitch(TVisit, TIntermSwitch *) override { return bends(true); }
	bool visitBranch(TVisit, TIntermBranch *) override { return bends(true); }
};

/*
 * Variables that stand for a product without effects: set once, and named once more, as a factor, in a statement that follows straight, with
 * nothing of the product changed by then. Mesa (22.3.6) puts the product there, and does it from a vector on.
 */
struct ProductFinder : TIntermTraverser {
	const std::map<long long, unsigned> named;
	Products products;

	explicit ProductFinder(const std::map<long long, unsigned> &n) : named(n) {}

	static bool holds(const std::vector<long long> &list, long long number) { return std::find(list.begin(), list.end(), number) != list.end(); }

	bool is_used_straight(const TIntermSequence &statements, size_t next, long long variable, TIntermBinary &product) const
	{
		Survey parts;

		product.traverse(&parts);
		if (!parts.is_straight || !parts.written.empty())
			return false;
		for (size_t end = std::min(next + MOST_STATEMENTS, statements.size()); next < end; next++) {
			Survey statement;

			statements[next]->traverse(&statement);
			if (!statement.is_straight || std::any_of(statement.written.begin(), statement.written.end(), [&](long long w) { return parts.named.count(w); }))
				return false;
			if (statement.named.count(variable))
				return holds(statement.factors, variable);
		}
		return false;
	}
	static bool is_list(const TIntermAggregate &a) { return a.getOp() == EOpSequence || a.getOp() == EOpScope; }

	/* Statements one after the other, those of blocks and of declarations among them. */
	static void list(const TIntermSequence &sequence, TIntermSequence &statements)
	{
		for (TIntermNode *node : sequence) {
			TIntermAggregate *a = node ? node->getAsAggregate() : nullptr;

			if (a && is_list(*a))
				list(a->getSequence(), statements);
			else if (node)
				statements.push_back(node);
		}
	}
	void find(const TIntermSequence &statements)
	{
		for (size_t i = 0; i < statements.size(); i++) {
			TIntermBinary *set = statements[i]->getAsBinaryNode(), *product = set && set->getOp() == EOpAssign ? as_product(set->getRight()) : nullptr;
			TIntermSymbol *to = product ? set->getLeft()->getAsSymbolNode() : nullptr;

			if (to && to->getQualifier().storage == EvqTemporary && named.at(to->getId()) == 2 && is_used_straight(statements, i + 1, to->getId(), *product))
				products[to->getId()] = product;
		}
	}
	bool visitAggregate(TVisit, TIntermAggregate *a) override
	{
		TIntermSequence statements;

		if (a->getOp() != EOpFunction && !is_list(*a))
			return true;
		list(a->getSequence(), statements);
		find(statements);
		return true;
	}
};

class Flattener {
public:
	std::vector<glsl_type> types;
	std::vector<glsl_member> members;
	std::vector<glsl_symbol> symbols;
	std::vector<glsl_node> nodes;
	std::vector<glsl_function> functions;
	std::vector<uint32_t> children;
	std::vector<float> numbers;
	std::string names;

	uint32_t flatten_all(TIntermNode *root)
	{
		Survey all;

		root->traverse(&all);
		ProductFinder finder(all.named);

		root->traverse(&finder);
		products = finder.products;
		return flatten(root);
	}

	uint32_t flatten(TIntermNode *node)
	{
		if (++depth > MAX_DEPTH)
			throw refused{ "a shader nests deeper than is done" };
		const uint32_t made = flatten_one(node);

		depth--;
		return made;
	}

	uint32_t function(const std::string &name)
	{
		const auto found = function_of.find(name);

		if (found != function_of.end())
			return found->second;
		functions.push_back({ add_name(name), type_of(TType(EbtVoid)), 0, 0, GLSL_NONE });
		return function_of[name] = uint32_t(functions.size() - 1);
	}

private:
	int depth = 0;
	Products products;
	std::map<long long, uint32_t> symbol_of;
	std::map<std::string, uint32_t> function_of, member_of;
	std::map<std::vector<uint32_t>, uint32_t> type_numbers;
	std::map<const TTypeList *, uint32_t> struct_of;

	uint32_t add_name(const std::string &name)
	{
		const size_t at = names.size();

		names.append(name.c_str(), strlen(name.c_str()) + 1);
		return uint32_t(at);
	}

	uint32_t intern(const glsl_type &t)
	{
		const std::vector<uint32_t> key = { t.kind, t.rows, t.columns, t.length, t.first, t.texture };
		const auto found = type_numbers.find(key);

		if (t.numbers > MAX_NUMBERS)
			throw refused{ "a shader has a larger array than is done" };
		if (found != type_numbers.end())
			return found->second;
		types.push_back(t);
		return type_numbers[key] = uint32_t(types.size() - 1);
	}

	uint32_t structure(const TType &type)
	{
		const TTypeList *list = type.getStruct();
		const auto found = struct_of.find(list);
		std::vector<glsl_member> own;
		glsl_type t = {};

		if (found != struct_of.end())
			return found->second;
		for (const TTypeLoc &member : *list) {
			own.push_back({ add_name(member.type->getFieldName().c_str()), type_of(*member.type) });
			t.numbers += types[own.back().type].numbers;
		}
		t.kind = GLSL_STRUCT;
		t.length = uint32_t(own.size());
		t.first = uint32_t(members.size());
		members.insert(members.end(), own.begin(), own.end());
		return struct_of[list] = intern(t);
	}

	uint32_t type_of(const TType &type)
	{
		glsl_type t = {};

		if (type.isArray()) {
			const TType element(type, 0);
			const int size = type.isUnsizedArray() ? type.getImplicitArraySize() : type.getOuterArraySize();

			t.kind = GLSL_ARRAY;
			t.length = uint32_t(size > 0 ? size : 1);
			t.first = type_of(element);
			if (t.length > MAX_NUMBERS)
				throw refused{ "a shader has a larger array than is done" };
			t.numbers = t.length * types[t.first].numbers;
			return intern(t);
		}
		switch (type.getBasicType()) {
		case EbtVoid: return intern(t);
		case EbtFloat: t.kind = GLSL_FLOAT; break;
		case EbtInt: t.kind = GLSL_INT; break;
		case EbtUint: t.kind = GLSL_UINT; break;
		case EbtBool: t.kind = GLSL_BOOL; break;
		case EbtStruct: return structure(type);
		case EbtBlock: throw refused{ "a shader has blocks of uniforms or of inputs, which are not done" };
		case EbtSampler: return sampler(type.getSampler());
		default: throw refused{ "a shader has a type that is not done" };
		}
		t.rows = uint32_t(type.isMatrix() ? type.getMatrixRows() : type.getVectorSize());
		t.columns = uint32_t(type.isMatrix() ? type.getMatrixCols() : 0);
		t.numbers = t.rows * (t.columns ? t.columns : 1);
		return intern(t);
	}

	uint32_t sampler(const TSampler &s)
	{
		static const std::map<int, uint32_t> kinds = { { Esd1D, GLSL_TEXTURE_1D }, { Esd2D, GLSL_TEXTURE_2D }, { Esd3D, GLSL_TEXTURE_3D },
			                                       { EsdCube, GLSL_TEXTURE_CUBE }, { EsdRect, GLSL_TEXTURE_RECTANGLE } };
		const auto found = kinds.find(s.dim);
		glsl_type t = {};

		t.kind = GLSL_SAMPLER;
		t.rows = t.numbers = 1;
		t.texture = found == kinds.end() || s.arrayed || s.ms || s.image || s.type != EbtFloat ? uint32_t(GLSL_TEXTURE_OTHER) : found->second;
		return intern(t);
	}

	static uint32_t storage_of(const TQualifier &q)
	{
		switch (q.storage) {
		case EvqGlobal: return GLSL_GLOBAL;
		case EvqConst: return GLSL_CONSTANT_VALUE;
		case EvqUniform: return GLSL_UNIFORM;
		case EvqVaryingIn: case EvqVertexId: case EvqInstanceId: case EvqFace: case EvqFragCoord: case EvqPointCoord: return GLSL_INPUT;
		case EvqVaryingOut: case EvqPosition: case EvqPointSize: case EvqClipVertex: case EvqFragColor: case EvqFragDepth: return GLSL_OUTPUT;
		case EvqIn: case EvqConstReadOnly: return GLSL_IN;
		case EvqOut: return GLSL_OUT;
		case EvqInOut: return GLSL_INOUT;
		default: return GLSL_LOCAL;
		}
	}

	uint32_t add_numbers(const TConstUnionArray &values)
	{
		const size_t at = numbers.size();

		if (at + size_t(values.size()) > MAX_NODES)
			throw refused{ "a shader has more numbers than are done" };
		for (int i = 0; i < values.size(); i++) {
			const TConstUnion &v = values[i];

			numbers.push_back(v.getType() == EbtBool ? float(v.getBConst()) : v.getType() == EbtInt ? float(v.getIConst()) :
			                  v.getType() == EbtUint ? float(v.getUConst()) : float(v.getDConst()));
		}
		return uint32_t(at);
	}

	uint32_t symbol(const TIntermSymbol &s)
	{
		const auto found = symbol_of.find(s.getId());
		const TQualifier &q = s.getType().getQualifier();

		if (found != symbol_of.end())
			return found->second;
		symbols.push_back({ add_name(s.getName().c_str()), type_of(s.getType()), storage_of(q),
		                    s.getConstArray().empty() ? GLSL_NONE : add_numbers(s.getConstArray()), uint32_t(q.flat),
		                    uint32_t(q.nopersp), q.hasLocation() ? uint32_t(q.layoutLocation) : GLSL_NONE,
		                    q.hasBinding() ? uint32_t(q.layoutBinding) : GLSL_NONE, uint32_t(s.getId()) });
		return symbol_of[s.getId()] = uint32_t(symbols.size() - 1);
	}

	uint32_t add(glsl_operator operation, uint32_t type, const std::vector<uint32_t> &own, uint32_t value = 0)
	{
		if (nodes.size() > MAX_NODES)
			throw refused{ "a shader is larger than is done" };
		nodes.push_back({ operation, type, uint32_t(children.size()), uint32_t(own.size()), value });
		children.insert(children.end(), own.begin(), own.end());
		return uint32_t(nodes.size() - 1);
	}

	uint32_t flatten_maybe(TIntermNode *node)
	{
		return node ? flatten(node) : GLSL_NONE;
	}

	uint32_t of_operator(const TIntermOperator &node, const std::vector<uint32_t> &own)
	{
		const TOperator op = node.getOp();
		const auto found = OPERATORS.find(op), assigned = ASSIGNED.find(op);
		const uint32_t type = type_of(node.getType());

		if (assigned != ASSIGNED.end())
			return add(GLSL_ASSIGN, type, own, assigned->second);
		if (found != OPERATORS.end())
			return add(found->second, type, own);
		if (node.isConstructor())
			return add(GLSL_CONSTRUCT, type, own);
		if (op >= EOpConvInt8ToBool && op <= EOpConvDoubleToFloat)
			return add(GLSL_CONVERT, type, own);
		return add(GLSL_OTHER, type, own);
	}

	/* From GLSL 1.50 on what a vertex shader hands on is a member of gl_PerVertex: a variable of its own, as before. */
	uint32_t of_block(const TIntermBinary &b)
	{
		const TType &block = b.getLeft()->getType();
		const size_t number = size_t(b.getRight()->getAsConstantUnion()->getConstArray()[0].getIConst());
		const std::string name = (*block.getStruct())[number].type->getFieldName().c_str();
		const auto found = member_of.find(name);

		if (block.getQualifier().storage != EvqVaryingOut || name.compare(0, 3, "gl_") != 0)
			throw refused{ "a shader has blocks of uniforms or of inputs, which are not done" };
		const uint32_t type = type_of(b.getType());

		if (found != member_of.end())
			return add(GLSL_SYMBOL, type, {}, found->second);
		symbols.push_back({ add_name(name), type, uint32_t(GLSL_OUTPUT), GLSL_NONE, 0, 0, GLSL_NONE, GLSL_NONE, 0 });
		member_of[name] = uint32_t(symbols.size() - 1);
		return add(GLSL_SYMBOL, type, {}, member_of[name]);
	}

	/* (A B) v is A (B v), however many matrices there are, as in Mesa (22.3.6). */
	uint32_t times_vector(TIntermTyped &matrix, uint32_t vector, const TType &type)
	{
		const auto held = matrix.getAsSymbolNode() ? products.find(matrix.getAsSymbolNode()->getId()) : products.end();
		TIntermBinary *product = as_product(held == products.end() ? &matrix : held->second);

		if (!product)
			return add(GLSL_MATRIX_TIMES_VECTOR, type_of(type), { flatten(&matrix), vector });
		TIntermTyped &right = *product->getRight();

		return times_vector(*product->getLeft(), times_vector(right, vector, TType(EbtFloat, EvqTemporary, right.getType().getMatrixRows())), type);
	}

	uint32_t flatten_binary(TIntermBinary &b)
	{
		if (b.getOp() == EOpIndexDirectStruct && b.getLeft()->getBasicType() == EbtBlock)
			return of_block(b);
		if (b.getOp() == EOpAssign && b.getLeft()->getAsSymbolNode() && products.count(b.getLeft()->getAsSymbolNode()->getId()))
			return add(GLSL_SEQUENCE, type_of(TType(EbtVoid)), {});
		if (b.getOp() == EOpMatrixTimesVector)
			return times_vector(*b.getLeft(), flatten(b.getRight()), b.getType());
		const uint32_t left = flatten(b.getLeft()), type = type_of(b.getType());

		if (b.getOp() == EOpIndexDirectStruct)
			return add(GLSL_MEMBER, type, { left }, uint32_t(b.getRight()->getAsConstantUnion()->getConstArray()[0].getIConst()));
		if (b.getOp() == EOpVectorSwizzle) {
			const TIntermSequence &parts = b.getRight()->getAsAggregate()->getSequence();
			uint32_t packed = 0;

			for (size_t i = 0; i < parts.size() && i < 4; i++)
				packed |= uint32_t(parts[i]->getAsConstantUnion()->getConstArray()[0].getIConst()) << 3 * i;
			return add(GLSL_SWIZZLE, type, { left }, packed);
		}
		const uint32_t right = flatten(b.getRight());

		if (b.getOp() == EOpIndexDirect || b.getOp() == EOpIndexIndirect)
			return add(GLSL_INDEX, type, { left, right });
		return of_operator(b, { left, right });
	}

	uint32_t flatten_aggregate(TIntermAggregate &a)
	{
		std::vector<uint32_t> own;

		if (a.getOp() == EOpLinkerObjects)
			return add(GLSL_SEQUENCE, type_of(TType(EbtVoid)), own);
		for (TIntermNode *child : a.getSequence())
			own.push_back(flatten(child));
		if (a.getOp() == EOpFunction) {
			const uint32_t f = function(a.getName().c_str()), parameters = own[0];

			functions[f].type = type_of(a.getType());
			functions[f].first = nodes[parameters].first;
			functions[f].count = nodes[parameters].count;
			functions[f].body = own.size() > 1 ? own[1] : add(GLSL_SEQUENCE, functions[f].type, {});
			return add(GLSL_SEQUENCE, functions[f].type, {});
		}
		if (a.getOp() == EOpFunctionCall)
			return add(GLSL_CALL, type_of(a.getType()), own, function(a.getName().c_str()));
		if (a.getOp() == EOpParameters || a.getOp() == EOpNull)
			return add(GLSL_SEQUENCE, type_of(TType(EbtVoid)), own);
		return of_operator(a, own);
	}

	uint32_t flatten_one(TIntermNode *node)
	{
		const uint32_t nothing = type_of(TType(EbtVoid));

		if (TIntermSymbol *s = node->getAsSymbolNode())
			return products.count(s->getId()) ? flatten(products[s->getId()]) : add(GLSL_SYMBOL, type_of(s->getType()), {}, symbol(*s));
		if (TIntermConstantUnion *c = node->getAsConstantUnion())
			return add(GLSL_NUMBERS, type_of(c->getType()), {}, add_numbers(c->getConstArray()));
		if (TIntermBinary *b = node->getAsBinaryNode())
			return flatten_binary(*b);
		if (TIntermUnary *u = node->getAsUnaryNode())
			return of_operator(*u, { flatten(u->getOperand()) });
		if (TIntermAggregate *a = node->getAsAggregate())
			return flatten_aggregate(*a);
		if (TIntermSelection *s = node->getAsSelectionNode()) {
			const uint32_t condition = flatten(s->getCondition()), yes = flatten_maybe(s->getTrueBlock());

			return add(GLSL_SELECTION, type_of(s->getType()), { condition, yes, flatten_maybe(s->getFalseBlock()) });
		}
		if (TIntermLoop *l = node->getAsLoopNode()) {
			const uint32_t test = flatten_maybe(l->getTest()), body = flatten_maybe(l->getBody());

			return add(GLSL_LOOP, nothing, { test, body, flatten_maybe(l->getTerminal()) }, l->testFirst());
		}
		if (TIntermSwitch *s = node->getAsSwitchNode()) {
			const uint32_t value = flatten(s->getCondition());

			return add(GLSL_SWITCH, nothing, { value, flatten(s->getBody()) });
		}
		if (TIntermBranch *b = node->getAsBranchNode()) {
			const auto found = OPERATORS.find(b->getFlowOp());

			return add(found == OPERATORS.end() ? GLSL_OTHER : found->second, nothing, { flatten_maybe(b->getExpression()) });
		}
		return add(GLSL_OTHER, nothing, {});
	}
};

template <typename T> T *copy_of(const T *from, size_t n)
{
	T *to = static_cast<T *>(malloc(n * sizeof(T) + 1));

	if (!to)
		throw std::bad_alloc();
	if (n)
		memcpy(to, from, n * sizeof(T));
	return to;
}

#define COPY(tree, from, field) ((tree)->n_##field = uint32_t((from).field.size()), (tree)->field = copy_of((from).field.data(), (from).field.size()))

/* Mesa's (22.3.6) limits where they are sizes of built-in arrays; else large ones: the program was linked when it was recorded. */
TBuiltInResource limits()
{
	TBuiltInResource r = {};

	r.maxLights = 8;
	r.maxClipPlanes = 8;
	r.maxTextureUnits = r.maxTextureCoords = 8;
	r.maxVertexAttribs = 16;
	r.maxVertexUniformComponents = r.maxFragmentUniformComponents = 16384;
	r.maxVaryingFloats = 128;
	r.maxVaryingComponents = r.maxVertexOutputComponents = r.maxFragmentInputComponents = 128;
	r.maxVaryingVectors = r.maxVertexOutputVectors = r.maxFragmentInputVectors = 32;
	r.maxVertexTextureImageUnits = r.maxTextureImageUnits = 32;
	r.maxCombinedTextureImageUnits = 160;
	r.maxDrawBuffers = 8;
	r.maxVertexUniformVectors = r.maxFragmentUniformVectors = 4096;
	r.minProgramTexelOffset = -32;
	r.maxProgramTexelOffset = 31;
	r.maxClipDistances = 8;
	r.maxSamples = 4;
	r.maxDualSourceDrawBuffersEXT = 1;
	r.limits.nonInductiveForLoops = r.limits.whileLoops = r.limits.doWhileLoops = r.limits.generalUniformIndexing =
		r.limits.generalAttributeMatrixVectorIndexing = r.limits.generalVaryingIndexing = r.limits.generalSamplerIndexing =
		r.limits.generalVariableIndexing = r.limits.generalConstantMatrixVectorIndexing = true;
	return r;
}

/* AMD_shader_trinary_minmax, which glslang has from GLSL 4.50 on, Mesa (22.3.6) in all versions. A preamble may hold nothing but macros. */
const char trinary[] = "#define min3(a, b, c) min(min(a, b), c)\n#define max3(a, b, c) max(max(a, b), c)\n"
		       "#define mid3(a, b, c) max(min(a, b), min(max(a, b), c))\n";

void parse(const char *const *texts, uint32_t n, EShLanguage stage, struct glsl_tree *tree)
{
	const EShMessages messages = EShMessages(EShMsgRelaxedErrors | EShMsgSuppressWarnings);
	const TBuiltInResource resources = limits();
	std::vector<std::unique_ptr<TShader>> shaders;
	TProgram program;
	Flattener flat;

	for (uint32_t i = 0; i < n; i++) {
		shaders.push_back(std::make_unique<TShader>(stage));
		shaders.back()->setStrings(&texts[i], 1);
		if (std::strstr(texts[i], "GL_AMD_shader_trinary_minmax"))
			shaders.back()->setPreamble(trinary);
		if (!shaders.back()->parse(&resources, 110, ENoProfile, false, false, messages))
			throw refused{ "a shader does not compile here" };
		program.addShader(shaders.back().get());
	}
	if (!program.link(messages))
		throw refused{ "a program's shaders do not link here" };
	TIntermediate *intermediate = program.getIntermediate(stage);

	if (!intermediate || !intermediate->getTreeRoot())
		throw refused{ "a shader is empty" };
	tree->root = flat.flatten_all(intermediate->getTreeRoot());
	tree->main = flat.function("main(");
	COPY(tree, flat, types);
	COPY(tree, flat, members);
	COPY(tree, flat, symbols);
	COPY(tree, flat, nodes);
	COPY(tree, flat, functions);
	COPY(tree, flat, children);
	COPY(tree, flat, numbers);
	COPY(tree, flat, names);
}

} // namespace

int glsl_parse(const char *const *texts, uint32_t n, enum glsl_stage stage, struct glsl_tree *tree, const char **why)
{
	static std::mutex alone; /* glslang's tables are the process's */
	static bool begun;
	const std::lock_guard<std::mutex> lock(alone);

	*why = nullptr;
	try {
		if (!begun && !InitializeProcess())
			return err_report(ERR_SYSTEM, NULL, "glslang does not start");
		begun = true;
		parse(texts, n, stage == GLSL_VERTEX_STAGE ? EShLangVertex : EShLangFragment, tree);
	} catch (const refused &r) {
		*why = r.why;
	} catch (const std::exception &e) {
		return err_report(ERR_SYSTEM, NULL, "glslang: %s", e.what());
	}
	return 0;
}
