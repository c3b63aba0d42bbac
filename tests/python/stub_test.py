"""Compares rayspace.pyi with the module: names, kinds, parameters and defaults. stub_test.py RAYSPACE.pyi"""

import ast
import inspect
import sys

import rayspace

failures = []


def parameters(arguments):
    """Names of the parameters in order, with their kind and whether they have a default."""
    positional = arguments.posonlyargs + arguments.args
    first_default = len(positional) - len(arguments.defaults)
    found = [(a.arg, "positional", i >= first_default) for i, a in enumerate(positional)]
    return found + [(a.arg, "keyword", d is not None) for a, d in zip(arguments.kwonlyargs, arguments.kw_defaults)]


def defaults(arguments):
    values = [d for d in arguments.defaults + arguments.kw_defaults if d is not None]
    return [ast.unparse(d) for d in values]


def compare_function(name, stub, function):
    documentation = inspect.getdoc(function)
    signature, _, text = documentation.partition("\n")
    real = ast.parse(f"def {signature}: ...").body[0].args
    if parameters(real) != parameters(stub.args):
        failures.append(f"{name}: the stub has {parameters(stub.args)}, the module {parameters(real)}")
    if defaults(real) != defaults(stub.args):
        failures.append(f"{name}: the stub's defaults are {defaults(stub.args)}, the module's {defaults(real)}")
    if not text.strip():
        failures.append(f"{name}: has no documentation")


def is_property(node):
    return any(ast.unparse(d) == "property" for d in node.decorator_list)


def compare_class(stub, cls):
    described = set()
    is_enumeration = any(ast.unparse(base) == "Enum" for base in stub.bases)
    for node in stub.body:
        if isinstance(node, ast.FunctionDef):
            described.add(node.name)
            member = inspect.getattr_static(cls, node.name, None)
            name = f"{stub.name}.{node.name}"
            if member is None:
                failures.append(f"{name}: is not in the module")
            elif is_property(node) != isinstance(member, property):
                failures.append(f"{name}: is a property in one of stub and module only")
            elif is_property(node):
                if not inspect.getdoc(member):
                    failures.append(f"{name}: has no documentation")
            else:
                compare_function(name, node, getattr(cls, node.name))
        elif isinstance(node, ast.AnnAssign):  # width: int
            described.add(node.target.id)
            member = inspect.getattr_static(cls, node.target.id, None)
            if not isinstance(member, property) or member.fset is None:
                failures.append(f"{stub.name}.{node.target.id}: is not a writable member of the module's class")
        elif isinstance(node, ast.Assign):  # AUTO = 0
            described.add(node.targets[0].id)
            member = getattr(cls, node.targets[0].id, None)
            if member is None or int(member) != node.value.value:
                failures.append(f"{stub.name}.{node.targets[0].id}: has another value in the module")
    generated = {"name", "value"} if is_enumeration else set()
    public = {name for name in vars(cls) if not name.startswith("_")} - generated
    for name in public - described:
        failures.append(f"{stub.name}.{name}: is not in the stub")


with open(sys.argv[1], encoding="utf-8") as file:
    tree = ast.parse(file.read())
classes = {n.name: n for n in tree.body if isinstance(n, ast.ClassDef)}
functions = {n.name: n for n in tree.body if isinstance(n, ast.FunctionDef)}
for name, cls in inspect.getmembers(rayspace, inspect.isclass):
    if name not in classes:
        failures.append(f"{name}: is not in the stub")
        continue
    if not inspect.getdoc(cls):
        failures.append(f"{name}: has no documentation")
    compare_class(classes.pop(name), cls)
for name, function in inspect.getmembers(rayspace, inspect.isroutine):
    if name not in functions:
        failures.append(f"{name}: is not in the stub")
        continue
    compare_function(name, functions.pop(name), function)
failures += [f"{name}: is not in the module" for name in [*classes, *functions]]
print("\n".join(failures))
sys.exit(1 if failures else 0)
