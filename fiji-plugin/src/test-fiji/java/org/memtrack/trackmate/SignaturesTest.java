// SPDX-License-Identifier: GPL-3.0-or-later
package org.memtrack.trackmate;

import static org.assertj.core.api.Assertions.assertThat;

import java.lang.reflect.Executable;
import java.lang.reflect.Field;
import java.lang.reflect.Member;
import java.lang.reflect.Method;
import java.lang.reflect.Modifier;
import java.net.URL;
import java.net.URLClassLoader;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.stream.Stream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;

/** The hand-written signatures that the default build compiles against are those of the real TrackMate. */
class SignaturesTest {
    private static final Path SIGNATURES = Path.of("trackmate-signatures", "target", "classes");
    private static final int SHARED = Modifier.PUBLIC | Modifier.PROTECTED | Modifier.STATIC | Modifier.INTERFACE;

    /** Loads our signatures first, everything else as usual. */
    private static final class SignatureLoader extends URLClassLoader {
        SignatureLoader() throws Exception {
            super(new URL[] {SIGNATURES.toUri().toURL()}, SignaturesTest.class.getClassLoader());
        }

        @Override
        protected Class<?> loadClass(String name, boolean resolve) throws ClassNotFoundException {
            Class<?> loaded = findLoadedClass(name);
            if (loaded == null && findResource(name.replace('.', '/') + ".class") != null) {
                loaded = findClass(name);
            }
            return loaded == null ? super.loadClass(name, resolve) : loaded;
        }
    }

    static List<String> names() throws Exception {
        try (Stream<Path> files = Files.walk(SIGNATURES)) {
            return files.map(file -> SIGNATURES.relativize(file).toString())
                    .filter(file -> file.endsWith(".class"))
                    .map(file -> file.substring(0, file.length() - ".class".length())
                            .replace('/', '.')
                            .replace('\\', '.'))
                    .sorted()
                    .toList();
        }
    }

    @Test
    void thereAreSignaturesToCompare() throws Exception {
        assertThat(names()).contains("fiji.plugin.trackmate.Spot").hasSizeGreaterThan(20);
    }

    @ParameterizedTest
    @MethodSource("names")
    void everySignatureIsTheRealOne(String name) throws Exception {
        try (SignatureLoader loader = new SignatureLoader()) {
            Class<?> ours = Class.forName(name, false, loader);
            Class<?> real = Class.forName(name, false, getClass().getClassLoader());
            assertThat(ours.getClassLoader()).isSameAs(loader).isNotSameAs(real.getClassLoader());

            List<String> differences = new ArrayList<>();
            compare("kind", kind(ours), kind(real), differences);
            compare("type parameters", typeParameters(ours), typeParameters(real), differences);
            for (Class<?> parent : parents(ours)) {
                if (parents(real).stream().noneMatch(other -> inherits(other, parent.getName()))) {
                    differences.add("real one is no " + parent.getName());
                }
            }
            for (Member member : members(ours).stream().filter(our -> !our.isSynthetic()).toList()) {
                String wanted = describe(member);
                if (allMembers(real).noneMatch(other -> describe(other).equals(wanted))) {
                    differences.add("real one has no " + wanted);
                }
            }
            for (Field field : ours.getDeclaredFields()) {
                if (Modifier.isPublic(field.getModifiers()) && field.getType() == String.class) {
                    compare(field.getName(), field.get(null), real.getField(field.getName()).get(null), differences);
                }
            }
            if (real.isInterface()) {
                for (Method method : real.getDeclaredMethods()) {
                    if (Modifier.isAbstract(method.getModifiers())
                            && members(ours).stream().noneMatch(our -> describe(our).equals(describe(method)))
                            && name.startsWith("fiji.")) {
                        differences.add("real one also has abstract " + describe(method));
                    }
                }
            }
            assertThat(differences).as(name).isEmpty();
        }
    }

    private static void compare(String what, Object ours, Object real, List<String> differences) {
        if (!ours.equals(real)) {
            differences.add("%s is %s, in reality %s".formatted(what, ours, real));
        }
    }

    private static String kind(Class<?> type) {
        return Modifier.toString(type.getModifiers() & SHARED) + (type.isEnum() ? " enum" : "");
    }

    private static String typeParameters(Class<?> type) {
        return Arrays.stream(type.getTypeParameters())
                .map(parameter -> parameter + " extends " + Arrays.toString(parameter.getBounds()))
                .toList()
                .toString();
    }

    private static List<Class<?>> parents(Class<?> type) {
        List<Class<?>> parents = new ArrayList<>(List.of(type.getInterfaces()));
        if (type.getSuperclass() != null) {
            parents.add(type.getSuperclass());
        }
        return parents;
    }

    private static boolean inherits(Class<?> type, String ancestor) {
        return type.getName().equals(ancestor)
                || parents(type).stream().anyMatch(parent -> inherits(parent, ancestor));
    }

    /** What others may call or override. */
    private static List<Member> members(Class<?> type) {
        return Stream.<Member[]>of(type.getDeclaredFields(), type.getDeclaredMethods(), type.getDeclaredConstructors())
                .flatMap(Arrays::stream)
                .filter(member -> (member.getModifiers() & (Modifier.PUBLIC | Modifier.PROTECTED)) != 0)
                .toList();
    }

    private static Stream<Member> allMembers(Class<?> type) {
        Stream<Member> inherited = parents(type).stream()
                .flatMap(SignaturesTest::allMembers)
                .filter(member -> !(member instanceof java.lang.reflect.Constructor));
        return Stream.concat(members(type).stream(), inherited);
    }

    /** What the virtual machine links by: access, whether static, name and erased types. */
    private static String describe(Member member) {
        String access = Modifier.toString(member.getModifiers() & (Modifier.PUBLIC | Modifier.PROTECTED | Modifier.STATIC));
        if (member instanceof Field field) {
            return "%s %s %s".formatted(access, field.getType().getName(), field.getName());
        }
        Executable executable = (Executable) member;
        String result = member instanceof Method method ? method.getReturnType().getName() : "";
        String name = member instanceof Method ? member.getName() : "<init>";
        String parameters = Arrays.stream(executable.getParameterTypes())
                .map(Class::getName)
                .toList()
                .toString();
        return "%s %s %s%s".formatted(access, result, name, parameters);
    }
}
